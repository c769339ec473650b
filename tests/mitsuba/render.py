"""Renders the scenes beside this file with Mitsuba 3, for tests/mitsuba.rs to compare with.

    pip install mitsuba==3.9.1 && python3 tests/mitsuba/render.py

writes NAME.exr for each NAME.toml, and panorama.exr, an image of a sky that a scene shows: linear R, G, B, the mean of RUNS independent pictures, and
error.R, error.G, error.B, the standard error of that mean; RUNS itself is the attribute "runs".
Needs Python 3.11 for its TOML parser, and takes about a minute on two cores.

The mapping. Mitsuba's sensor `thinlens` has a focal plane, not a sphere, and takes the radius. A matte surface of
kd = 1 and ka = 0 is `diffuse`; a directional light of some radiance is `directional` of that
irradiance; a clear body of smooth glass is `dielectric`, and a lamp has an `area` emitter. The plane is a rectangle that reaches beyond the picture. Its checker is shifted by
1.87e-4 as this program shifts it, and that shift puts the plane itself into the odd layer of cells. The image of a sky is
an `envmap`, whose middle lies in the direction +z, and whose first and last rows lie at the poles: so it gets a row between each
two rows of the image, and one at each pole.
"""

import pathlib
import tomllib

import mitsuba

mitsuba.set_variant("scalar_rgb")

RUNS = 64
SAMPLES = 1024
HALF_EDGE = 48.0
SHIFT = 1.87e-4
FOLDER = pathlib.Path(__file__).parent


def integrator(scene):
    """`whitted` without mirrors is direct light. A path of n bounces has n + 1 edges."""
    if scene.get("integrator") == "path":
        return {"type": "path", "max_depth": scene["max_bounces"] + 1}
    return {"type": "direct"}


def rgb(value):
    return {"type": "rgb", "value": value}


def diffuse(material):
    assert material.get("kd", 1) == 1, "Mitsuba has no such coefficient"
    color = material["color"]
    if not isinstance(color, dict):
        return {"type": "diffuse", "reflectance": rgb(color)}
    # One period of the texture is two cells. u runs along x, v against z.
    cells = 0.5 / color["size"]
    transform = mitsuba.ScalarTransform4f()
    to_uv = transform.translate(
        [-(HALF_EDGE + SHIFT) * cells, (HALF_EDGE - SHIFT) * cells, 0]
    ).scale([2 * HALF_EDGE * cells, -2 * HALF_EDGE * cells, 1])
    board = {
        "type": "checkerboard",
        "color0": rgb(color["odd"]),
        "color1": rgb(color["even"]),
        "to_uv": to_uv,
    }
    return {"type": "diffuse", "reflectance": board}


def material_of(scene, name):
    """The BSDF of a material, and its emitter if it is a lamp."""
    for kind in ["matte", "mirror", "glass", "emissive"]:
        material = scene.get(kind, {}).get(name)
        if material is not None:
            break
    if kind == "matte":
        return {"bsdf": diffuse(material)}
    if kind == "mirror":
        color = [material["kr"] * x for x in material["color"]]
        bsdf = {"type": "conductor", "material": "none", "specular_reflectance": rgb(color)}
        return {"bsdf": {"type": "twosided", "nested": bsdf}}
    if kind == "glass":
        return {"bsdf": {"type": "dielectric", "int_ior": material["index"], "ext_ior": 1.0}}
    radiance = [material["radiance"] * x for x in material.get("color", [1, 1, 1])]
    return {
        "bsdf": {"type": "diffuse", "reflectance": rgb([0, 0, 0])},
        "emitter": {"type": "area", "radiance": rgb(radiance)},
    }


def write_panorama():
    """A sky of 32 x 16 texels: a gradient, a brighter side, and a sun of two texels."""
    width, height = 32, 16
    values = []
    for y in range(height):
        for x in range(width):
            sun = 1 if y == 4 and x in (20, 21) else 0
            side = 0.2 + 0.4 * x / width
            up = max(1 - 2 * y / height, 0)
            values += [side + 9 * sun, 0.3 + 0.2 * up + 8 * sun, 0.3 + 0.5 * up + 6 * sun]
    bitmap = mitsuba.Bitmap(mitsuba.TensorXf(values, (height, width, 3)))
    # This program keeps colours in 16 bits, so both read the same ones.
    bitmap = bitmap.convert(component_format=mitsuba.Struct.Type.Float16)
    bitmap.write(str(FOLDER / "panorama.exr"))


def sky(background):
    if "image" not in background:
        return {"type": "constant", "radiance": rgb(background["color"])}
    bitmap = mitsuba.Bitmap(str(FOLDER / background["image"]))
    bitmap = bitmap.convert(component_format=mitsuba.Struct.Type.Float32)
    width, height = bitmap.size()
    values = list(mitsuba.TensorXf(bitmap).array)
    rows = [values[3 * width * y : 3 * width * (y + 1)] for y in range(height)]
    # Half of a turn puts the middle of the image into the direction -z.
    rows = [row[3 * width // 2 :] + row[: 3 * width // 2] for row in rows]
    between = [[(a + b) / 2 for a, b in zip(*pair)] for pair in zip(rows, rows[1:])]
    woven = [rows[0]] + [row for pair in zip(rows, between) for row in pair] + [rows[-1], rows[-1]]
    flat = [value for row in woven for value in row]
    return {
        "type": "envmap",
        "bitmap": mitsuba.Bitmap(mitsuba.TensorXf(flat, (2 * height + 1, width, 3))),
        "scale": background.get("radiance", 1.0),
        "to_world": mitsuba.ScalarTransform4f().rotate([0, 1, 0], background.get("turn_degrees", 0)),
    }


def translate(scene):
    transform = mitsuba.ScalarTransform4f()
    camera, (width, height) = scene["camera"], scene["size"]
    result = {
        "type": "scene",
        "integrator": integrator(scene),
        "sensor": {
            "type": "thinlens",
            "fov": camera["vfov_degrees"],
            "fov_axis": "y",
            "aperture_radius": camera["lens_diameter"] / 2,
            "focus_distance": camera["focal_distance"],
            "to_world": transform.look_at(
                origin=camera["eye"], target=camera["look_at"], up=camera.get("up", [0, 1, 0])
            ),
            "film": {
                "type": "hdrfilm",
                "width": width,
                "height": height,
                "pixel_format": "rgb",
                "rfilter": {"type": "box"},
            },
            "sampler": {"type": "independent", "sample_count": SAMPLES},
        },
    }
    for light in scene.get("directional", []):
        result["light"] = {
            "type": "directional",
            "direction": [-x for x in light["direction"]],
            "irradiance": rgb([light["radiance"] * x for x in light.get("color", [1, 1, 1])]),
        }
    if "background" in scene:
        result["sky"] = sky(scene["background"])
    for plane in scene.get("plane", []):
        assert plane["point"] == [0, 0, 0] and plane["normal"] == [0, 1, 0]
        result["plane"] = {
            "type": "rectangle",
            "to_world": transform.rotate([1, 0, 0], -90).scale(HALF_EDGE),
            "bsdf": diffuse(scene["matte"][plane["material"]]),
        }
    for number, sphere in enumerate(scene["sphere"]):
        result[f"sphere{number}"] = {
            "type": "sphere",
            "center": sphere["center"],
            "radius": sphere["radius"],
            **material_of(scene, sphere["material"]),
        }
    return mitsuba.load_dict(result)


def main():
    write_panorama()
    for path in sorted(FOLDER.glob("*.toml")):
        scene = tomllib.loads(path.read_text())
        width, height = scene["size"]
        loaded = translate(scene)
        runs = [list(mitsuba.render(loaded, seed=seed).array) for seed in range(RUNS)]
        values = []
        for pixel in range(width * height):
            channels = [[run[3 * pixel + channel] for run in runs] for channel in range(3)]
            means = [sum(channel) / RUNS for channel in channels]
            squares = [
                sum((value - mean) ** 2 for value in channel)
                for channel, mean in zip(channels, means)
            ]
            errors = [(square / (RUNS - 1) / RUNS) ** 0.5 for square in squares]
            values += means + errors
        tensor = mitsuba.TensorXf(values, (height, width, 6))
        names = ["R", "G", "B", "error.R", "error.G", "error.B"]
        bitmap = mitsuba.Bitmap(tensor, mitsuba.Bitmap.PixelFormat.MultiChannel, names)
        bitmap.metadata()["runs"] = RUNS
        bitmap.write(str(path.with_suffix(".exr")))
        print(f"{path.stem}: {RUNS} pictures of {SAMPLES} samples a pixel")


if __name__ == "__main__":
    main()
