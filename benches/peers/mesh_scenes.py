"""Two scenes with a mesh: a bumpy ring with smooth normals on a ground, at any number of triangles.

The same surface at both numbers, so that only the mesh's fineness differs. Written as OBJ beside a
scene file; every renderer reads the same OBJ.
"""

import numpy

# name: quads around the ring and around its tube; two triangles each.
GRIDS = {"mesh-102400": (320, 160), "mesh-1048576": (1024, 512)}

RING_RADIUS = 1.3
TUBE_RADIUS = 0.55
CENTER = (0.0, 0.62, -6.0)

SCENE = """\
size = [640, 480]

[camera]
eye = [0, 2.6, 0]
look_at = [0, 0.7, -6]
vfov_degrees = 33
lens_diameter = 0.25
focal_distance = 5.2

[background]
color = [0.4, 0.5, 0.65]

[ambient]
radiance = 0.3

[[directional]]
direction = [-0.6, 1, 0.5]
radiance = 2.6

[matte.clay]
ka = 0.7
kd = 0.8
color = [0.75, 0.5, 0.35]

[matte.ground]
ka = 0.7
kd = 0.8
color = [0.5, 0.5, 0.5]

[[plane]]
point = [0, 0, 0]
normal = [0, 1, 0]
material = "ground"

[[mesh]]
file = "{name}.obj"
material = "clay"
"""


def write(name, folder):
    """Writes NAME.obj and NAME.toml into the folder; returns the scene file's path."""
    around, across = GRIDS[name]
    ring, tube = numpy.meshgrid(
        2 * numpy.pi * numpy.arange(around) / around,
        2 * numpy.pi * numpy.arange(across) / across,
        indexing="ij",
    )
    positions = _surface(ring, tube)
    # Central differences of the surface itself, so that the normals do not depend on the grid.
    step = 1e-4
    along_ring = _surface(ring + step, tube) - _surface(ring - step, tube)
    along_tube = _surface(ring, tube + step) - _surface(ring, tube - step)
    normals = numpy.cross(along_ring, along_tube)
    normals /= numpy.linalg.norm(normals, axis=-1, keepdims=True)

    index = numpy.arange(around * across).reshape(around, across) + 1
    right, up = numpy.roll(index, -1, axis=0), numpy.roll(index, -1, axis=1)
    corner = numpy.roll(right, -1, axis=1)
    faces = numpy.stack([index, corner, up, index, right, corner], axis=-1).reshape(-1, 3)

    with open(folder / f"{name}.obj", "w") as obj:
        numpy.savetxt(obj, positions.reshape(-1, 3), "v %.7g %.7g %.7g")
        numpy.savetxt(obj, normals.reshape(-1, 3), "vn %.6f %.6f %.6f")
        numpy.savetxt(obj, numpy.repeat(faces, 2, axis=1), "f %d//%d %d//%d %d//%d")
    path = folder / f"{name}.toml"
    path.write_text(SCENE.format(name=name))
    return path


def _surface(ring, tube):
    """Points of the bumpy ring, which lies around the upward axis; angles in radians."""
    radius = TUBE_RADIUS * (1 + 0.08 * numpy.sin(14 * ring) * numpy.sin(9 * tube))
    radius += 0.005 * numpy.sin(50 * ring + 3 * numpy.sin(11 * tube))
    out = RING_RADIUS + radius * numpy.cos(tube)
    points = numpy.stack(
        [out * numpy.cos(ring), radius * numpy.sin(tube), -out * numpy.sin(ring)], axis=-1
    )
    return points + numpy.asarray(CENTER)
