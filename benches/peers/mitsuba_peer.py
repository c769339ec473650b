"""Renders with Mitsuba 3, variant llvm_ad_rgb; peer.py describes the job.

The job also has "integrator", one of INTEGRATORS, and "sampler", "independent" or "multijitter".
README.md says what differs from thinlens.
"""

import math
import os
import pathlib
import sys
import tempfile
import time

import numpy
import peer
import scenes

# Where LLVM is not named, Debian's libllvm19 by the name that the loader finds it under.
os.environ.setdefault("DRJIT_LIBLLVM_PATH", "libLLVM.so.19.1")
try:
    import drjit
    import mitsuba

    mitsuba.set_variant("llvm_ad_rgb")
except ImportError as error:
    sys.exit(
        f"Mitsuba does not start ({error}): pip install mitsuba==3.9.1, apt install libllvm19, and "
        "name LLVM's library in DRJIT_LIBLLVM_PATH where it is not found"
    )

INTEGRATORS = {
    "path": {"type": "path", "max_depth": 5},
    "direct": {"type": "direct"},
    # Nothing but a shadow ray from the first surface: mirrors stay black.
    "lights": {"type": "direct", "emitter_samples": 1, "bsdf_samples": 0},
}

# Half the edge of the square that stands for the endless ground, in scene units.
GROUND = 10000.0
# The sky is a picture of one column's colours; this many rows from zenith to nadir.
SKY_ROWS = 1024
# More samples than this are rendered as several pictures and averaged: all lanes live at once.
SAMPLES_PER_PASS = 256


def rgb(value):
    return {"type": "rgb", "value": [float(x) for x in value]}


def texture(color, to_uv=None):
    """One period of the checkerboard texture is two cells."""
    if not isinstance(color, scenes.Checker):
        return rgb(color)
    board = {"type": "checkerboard", "color0": rgb(color.even), "color1": rgb(color.odd)}
    return board if to_uv is None else board | {"to_uv": to_uv}


def bsdf(material, to_uv=None):
    """Mitsuba has no Phong lobe, and its own cost more: highlights are left out."""
    if material.kind == "mirror":
        reflectance = rgb(material.scaled(material.kr))
        return {"type": "conductor", "material": "none", "specular_reflectance": reflectance}
    if material.kind == "emissive":
        return {"type": "diffuse", "reflectance": rgb([0, 0, 0])}
    return {"type": "diffuse", "reflectance": texture(material.scaled(material.kd), to_uv)}


def ground(material):
    """The plane y = 0. u runs along x, v against z; the shift puts it into the odd layer."""
    transform, to_uv = mitsuba.ScalarTransform4f(), None
    if isinstance(material.color, scenes.Checker):
        cells = 0.5 / material.color.size
        shift = scenes.CHECKER_SHIFT
        offset = [-(GROUND + shift) * cells + 0.5, (GROUND - shift) * cells, 0]
        to_uv = transform.translate(offset).scale([2 * GROUND * cells, -2 * GROUND * cells, 1])
    return {
        "type": "rectangle",
        "to_world": transform.rotate([1, 0, 0], -90).scale(GROUND),
        "bsdf": bsdf(material, to_uv),
    }


def box(keys, material, path):
    """An OBJ whose texture coordinates lay the checkerboard as the checker in space cuts it."""
    size = material.color.size if isinstance(material.color, scenes.Checker) else 1.0
    lines, count = [], 0
    for axis, place, corners in scenes.box_faces(keys["lower"], keys["upper"]):
        layer = math.floor((place - scenes.CHECKER_SHIFT) / size)
        for corner in corners:
            u = (corner[(axis + 1) % 3] - scenes.CHECKER_SHIFT) / size + layer
            v = (corner[(axis + 2) % 3] - scenes.CHECKER_SHIFT) / size
            lines += ["v {} {} {}".format(*corner), f"vt {u / 2} {v / 2}"]
        for b, c in ((2, 3), (3, 4)):
            lines.append("f " + " ".join(f"{count + i}/{count + i}" for i in (1, b, c)))
        count += 4
    path.write_text("\n".join(lines) + "\n")
    # Mitsuba turns v upside down for OBJ files, and keeps it for this flag.
    return {
        "type": "obj",
        "filename": str(path),
        "face_normals": True,
        "flip_tex_coords": False,
        "bsdf": bsdf(material),
    }


def triangle(keys, material, path):
    lines = ["v {} {} {}".format(*vertex) for vertex in keys["vertices"]]
    path.write_text("\n".join(lines + ["f 1 2 3"]) + "\n")
    both = {"type": "twosided", "bsdf": bsdf(material)}
    return {"type": "obj", "filename": str(path), "face_normals": True, "bsdf": both}


def shape(scene, kind, keys, path):
    material = scene.materials[keys["material"]]
    if kind == "plane":
        return ground(material)
    if kind == "box":
        return box(keys, material, path)
    if kind == "triangle":
        return triangle(keys, material, path)
    if kind == "mesh":
        mesh = scene.path.parent / keys["file"]
        return {"type": "obj", "filename": str(mesh), "bsdf": bsdf(material)}
    result = {
        "type": "sphere",
        "center": keys["center"],
        "radius": keys["radius"],
        "bsdf": bsdf(material),
    }
    if material.kind == "emissive":
        # Seen, and met by chance, but never aimed at: it lights next to nothing.
        radiance = rgb(material.scaled(material.radiance))
        result["emitter"] = {"type": "area", "radiance": radiance, "sampling_weight": 0.0}
    return result


def sky(scene):
    if scene.horizon == scene.zenith:
        return {"type": "constant", "radiance": rgb(scene.horizon), "sampling_weight": 0.0}
    height = numpy.cos(numpy.pi * (numpy.arange(SKY_ROWS) + 0.5) / SKY_ROWS).clip(0, 1)
    share = (height * (2 - height))[:, None, None]
    rows = (1 - share) * numpy.array(scene.horizon) + share * numpy.array(scene.zenith)
    bitmap = mitsuba.Bitmap(numpy.repeat(rows, 4, axis=1).astype(numpy.float32))
    return {"type": "envmap", "bitmap": bitmap, "sampling_weight": 0.0}


def light(light, camera):
    weight = float(sum(light.radiance))
    if light.directional:
        return {
            "type": "directional",
            "direction": [-x for x in light.vector],
            "irradiance": rgb(light.radiance),
            "sampling_weight": weight,
        }
    # It weakens with distance; equally strong at the point in focus.
    distance = math.dist(light.vector, camera.focus())
    return {
        "type": "point",
        "position": light.vector,
        "intensity": rgb(scenes.times(light.radiance, distance**2)),
        "sampling_weight": weight,
    }


def translate(scene, job, folder):
    camera, (width, height) = scene.camera, job["size"]
    result = {
        "type": "scene",
        "integrator": INTEGRATORS[job["integrator"]],
        "sensor": {
            "type": "thinlens",
            "fov": math.degrees(camera.vfov),
            "fov_axis": "y",
            "aperture_radius": camera.lens_diameter / 2,
            "focus_distance": camera.focal_distance,
            "to_world": mitsuba.ScalarTransform4f().look_at(
                origin=camera.eye, target=camera.look_at, up=camera.up
            ),
            "film": {
                "type": "hdrfilm",
                "width": width,
                "height": height,
                "pixel_format": "rgb",
                "component_format": "float32",
                "rfilter": {"type": "box"},
            },
            "sampler": {"type": job["sampler"]},
        },
        "sky": sky(scene),
    }
    for number, each in enumerate(scene.lights):
        result[f"light{number}"] = light(each, camera)
    for number, (kind, keys) in enumerate(scene.shapes):
        result[f"shape{number}"] = shape(scene, kind, keys, folder / f"{number}.obj")
    return mitsuba.load_dict(result)


def prepare(job):
    drjit.set_thread_count(job["threads"])
    with tempfile.TemporaryDirectory() as folder:
        scene = translate(scenes.load(job["scene"]), job, pathlib.Path(folder))

    def timed(samples, seed):
        start = time.perf_counter()
        picture = mitsuba.render(scene, spp=samples, seed=seed)
        drjit.eval(picture)
        drjit.sync_thread()
        return time.perf_counter() - start, picture.numpy()

    def render(samples):
        one = min(samples, SAMPLES_PER_PASS)
        # Mitsuba compiles a kernel for each number of samples, outside the measured time.
        timed(one, seed=0)
        passes = [timed(one, seed=1000 * job["seed"] + i) for i in range(samples // one)]
        return sum(seconds for seconds, _ in passes), numpy.mean([p for _, p in passes], axis=0)

    return f"Mitsuba {mitsuba.__version__} llvm_ad_rgb", render


if __name__ == "__main__":
    peer.main(prepare)
