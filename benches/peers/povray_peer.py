"""Renders with POV-Ray 3.7, focal blur; peer.py describes the job.

POV-Ray says itself how long it traced ("Trace Time"), without its start, parsing and writing: those
seconds are reported. README.md says what differs from thinlens.
"""

import math
import pathlib
import re
import shutil
import subprocess
import sys

import OpenEXR
import peer
import scenes

# A directional light stands this far away.
FAR = 1e5
# The sky's colours between the horizon and the zenith, with straight lines between them.
SKY_STEPS = 64


def vector(values):
    return "<" + ", ".join(f"{float(x):.7g}" for x in values) + ">"


def pigment(material):
    if isinstance(material.color, scenes.Checker):
        board = material.color
        return (
            f"pigment {{ checker rgb {vector(board.even)}, rgb {vector(board.odd)} "
            f"scale {board.size} translate {scenes.CHECKER_SHIFT} }}"
        )
    return f"pigment {{ rgb {vector(material.color)} }}"


def finish(material, ambient):
    """Lights carry radiance / pi, so diffuse is kd; highlights, not divided by pi, take it back."""
    shine = f"phong {material.ks * math.pi} phong_size {material.exponent}" if material.ks else ""
    if material.kind == "mirror":
        reflection = f"reflection {{ rgb {vector(material.scaled(material.kr))} }}"
        return f"pigment {{ rgb 0 }} finish {{ ambient 0 diffuse 0 {reflection} {shine} }}"
    if material.kind == "emissive":
        emission = f"emission {material.radiance}"
        return f"{pigment(material)} finish {{ ambient 0 diffuse 0 {emission} }}"
    # Its ambient light is white, of radiance 1, and the finish's ambient may have a colour.
    glow = vector(scenes.times(ambient, material.ka))
    return f"{pigment(material)} finish {{ ambient rgb {glow} diffuse {material.kd} {shine} }}"


def shape(scene, kind, keys):
    look = finish(scene.materials[keys["material"]], scene.ambient)
    if kind == "plane":
        return f"plane {{ y, 0 {look} }}"
    if kind == "sphere":
        return f"sphere {{ {vector(keys['center'])}, {keys['radius']} {look} }}"
    if kind == "box":
        return f"box {{ {vector(keys['lower'])}, {vector(keys['upper'])} {look} }}"
    if kind == "triangle":
        return f"triangle {{ {', '.join(map(vector, keys['vertices']))} {look} }}"
    return mesh(scene.path.parent / keys["file"], look)


def mesh(path, look):
    """The OBJ of mesh_scenes.py, in which a vertex and its normal have the same number."""
    parts = {"v": [], "vn": [], "f": []}
    for line in path.read_text().splitlines():
        kind, rest = line.split(" ", 1)
        parts[kind].append(rest)

    def block(name, lines):
        entries = ",\n".join("<" + line.replace(" ", ",") + ">" for line in lines)
        return f"{name} {{ {len(lines)},\n{entries}\n}}"

    corners = (" ".join(str(int(c.split("//")[0]) - 1) for c in f.split()) for f in parts["f"])
    return "\n".join(
        [
            "mesh2 {",
            block("vertex_vectors", parts["v"]),
            block("normal_vectors", parts["vn"]),
            block("face_indices", list(corners)),
            look,
            "}",
        ]
    )


def light(light):
    place = scenes.times(light.vector, FAR) if light.directional else light.vector
    color = vector(scenes.times(light.radiance, 1 / math.pi))
    kind = "parallel point_at <0, 0, 0>" if light.directional else ""
    shadows = "" if light.shadows else "shadowless"
    return f"light_source {{ {vector(place)}, rgb {color} {kind} {shadows} }}"


def sky(scene):
    if scene.horizon == scene.zenith:
        return f"background {{ rgb {vector(scene.horizon)} }}"
    entries = []
    for step in range(SKY_STEPS + 1):
        height = step / SKY_STEPS
        share = height * (2 - height)
        color = [h + (z - h) * share for h, z in zip(scene.horizon, scene.zenith, strict=True)]
        entries.append(f"[{height} rgb {vector(color)}]")
    # Scaled a little: at the zenith itself the pattern would start again.
    colors = " ".join(entries)
    return f"sky_sphere {{ pigment {{ gradient y color_map {{ {colors} }} scale 1.001 }} }}"


def camera(camera, size, samples):
    """A right-handed camera. An aperture of 2 D blurs as a lens of diameter D does, as measured;
    with a variance of 0 no pixel stops early."""
    aspect = size[0] / size[1]
    hfov = math.degrees(2 * math.atan(aspect * math.tan(camera.vfov / 2)))
    return f"""camera {{ perspective
    location {vector(camera.eye)} right {-aspect:.7g} * x up y sky {vector(camera.up)}
    angle {hfov:.7g} look_at {vector(camera.look_at)}
    aperture {2 * camera.lens_diameter} focal_point {vector(camera.focus())}
    blur_samples {samples} variance 0 confidence 0.9
}}"""


def translate(scene, job, samples):
    return "\n".join(
        [
            "#version 3.7;",
            "global_settings { assumed_gamma 1 ambient_light rgb 1 "
            f"max_trace_level {scene.max_bounces + 1} }}",
            camera(scene.camera, job["size"], samples),
            sky(scene),
            *(light(each) for each in scene.lights),
            *(shape(scene, kind, keys) for kind, keys in scene.shapes),
        ]
    )


def prepare(job):
    if not shutil.which("povray"):
        sys.exit("POV-Ray is missing: apt install povray")
    folder = pathlib.Path(job["folder"])
    source, picture = folder / "scene.pov", folder / "povray.exr"
    scene = scenes.load(job["scene"])
    width, height = job["size"]

    def render(samples):
        source.write_text(translate(scene, job, samples))
        # Not to the screen, no antialiasing on top of the focal blur, OpenEXR.
        command = ["povray", f"+I{source}", f"+O{picture}", "+FE", "-D", "-A"]
        command += [f"+W{width}", f"+H{height}", f"+WT{job['threads']}"]
        done = subprocess.run(command, capture_output=True, text=True)
        time = re.search(r"Trace Time:.*\(([\d.]+) seconds\)", done.stderr)
        if done.returncode != 0 or not time:
            sys.exit(f"POV-Ray failed: {done.stderr.strip()[-500:]}")
        with OpenEXR.File(str(picture)) as exr:
            return float(time[1]), exr.channels()["RGB"].pixels

    version = subprocess.run(["povray", "--version"], capture_output=True, text=True)
    return re.search(r"POV-Ray [\d.]+\d", version.stdout + version.stderr)[0], render


if __name__ == "__main__":
    peer.main(prepare)
