"""Scenes as plain values, read from thinlens's own files, for the translations into the peers'.

Lengths are in scene units, y is up, angles in radians, colours and radiances linear RGB, as
docs/scenes.md describes them. Only what the compared scenes use is read; the rest is an error.
"""

import dataclasses
import math
import pathlib
import tomllib

import numpy

# Suffern's shift of the checker, which keeps faces on cell boundaries clean.
CHECKER_SHIFT = 1.87e-4


@dataclasses.dataclass
class Checker:
    even: list
    odd: list
    size: float


@dataclasses.dataclass
class Material:
    """One of the kinds of docs/scenes.md; keys that a kind lacks are zero."""

    kind: str
    color: list | Checker
    ka: float = 0.0
    kd: float = 0.0
    ks: float = 0.0
    exponent: float = 0.0
    kr: float = 0.0
    radiance: float = 0.0

    def scaled(self, factor):
        """The colour, both of a checker's, times a number or an RGB."""
        if isinstance(self.color, Checker):
            even, odd = (times(c, factor) for c in (self.color.even, self.color.odd))
            return Checker(even, odd, self.color.size)
        return times(self.color, factor)


@dataclasses.dataclass
class Light:
    """vector: the direction towards a directional light (unit length), or a point light's place."""

    directional: bool
    vector: list
    radiance: list
    shadows: bool


@dataclasses.dataclass
class Camera:
    eye: list
    look_at: list
    up: list
    vfov: float
    lens_diameter: float
    focal_distance: float

    def forward(self):
        return unit(numpy.subtract(self.look_at, self.eye))

    def focus(self):
        """The point of the focal plane on the camera's axis."""
        return [float(x) for x in numpy.add(self.eye, self.focal_distance * self.forward())]


@dataclasses.dataclass
class Scene:
    path: pathlib.Path
    camera: Camera
    max_bounces: int
    horizon: list
    zenith: list
    ambient: list
    lights: list
    materials: dict
    shapes: list  # (kind, keys): sphere, box, triangle, plane or mesh, with the keys of the file


def times(color, factor):
    return [float(x) for x in numpy.multiply(color, factor)]


def unit(vector):
    return numpy.asarray(vector, float) / numpy.linalg.norm(vector)


def load(path):
    """Reads a scene file. Raises ValueError or KeyError for what is not translated."""
    path = pathlib.Path(path)
    tables = tomllib.loads(path.read_text())
    background = tables.get("background", {"color": [0, 0, 0]})
    scene = Scene(
        path=path,
        camera=_camera(tables["camera"], tables.get("size", [1280, 720])),
        max_bounces=tables.get("max_bounces", 5),
        horizon=background.get("horizon") or background["color"],
        zenith=background.get("zenith") or background["color"],
        ambient=_radiance(tables.get("ambient", {"radiance": 0})),
        lights=[],
        materials={},
        shapes=[],
    )
    for light in tables.get("directional", []):
        towards = [float(x) for x in unit(light["direction"])]
        scene.lights.append(Light(True, towards, _radiance(light), light.get("shadows", True)))
    for light in tables.get("point", []):
        scene.lights.append(
            Light(False, light["position"], _radiance(light), light.get("shadows", True))
        )
    for kind in ("matte", "phong", "mirror", "emissive"):
        for name, keys in tables.get(kind, {}).items():
            color = keys.get("color", [1, 1, 1])
            keys["color"] = Checker(**color) if isinstance(color, dict) else color
            scene.materials[name] = Material(kind, **keys)
    for kind in ("plane", "sphere", "box", "triangle", "mesh"):
        for keys in tables.get(kind, []):
            if kind == "plane" and (keys["point"] != [0, 0, 0] or keys["normal"] != [0, 1, 0]):
                raise ValueError(f"{path}: only the plane y = 0 is translated")
            if kind == "mesh" and set(keys) != {"file", "material"}:
                raise ValueError(f"{path}: only meshes with file and material are translated")
            scene.shapes.append((kind, keys))
    return scene


def _radiance(table):
    return times(table.get("color", [1, 1, 1]), table["radiance"])


def _camera(keys, size):
    if "vfov_degrees" in keys:
        vfov = math.radians(keys["vfov_degrees"])
    else:
        vfov = 2 * math.atan(size[1] * keys["pixel_size"] / 2 / keys["view_distance"])
    return Camera(
        eye=keys["eye"],
        look_at=keys["look_at"],
        up=keys.get("up", [0, 1, 0]),
        vfov=vfov,
        lens_diameter=keys["lens_diameter"],
        focal_distance=keys["focal_distance"],
    )


def box_faces(lower, upper):
    """The six faces of a box: each (axis, place on it, four corners, wound to face outwards)."""
    bounds = (lower, upper)
    for axis in range(3):
        first, second = (axis + 1) % 3, (axis + 2) % 3
        for side in (0, 1):
            corners = []
            around = ((0, 0), (1, 0), (1, 1), (0, 1))
            for a, b in around if side else reversed(around):
                corner = [0.0, 0.0, 0.0]
                corner[axis] = bounds[side][axis]
                corner[first] = bounds[a][first]
                corner[second] = bounds[b][second]
                corners.append(corner)
            yield axis, bounds[side][axis], corners
