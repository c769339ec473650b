"""Renders with Blender's Cycles on the CPU; peer.py describes the job.

Blender keeps the scene between renders, so a render after the first is Cycles and what Blender does
around it: 0.04 s for each picture of 640 x 480, of the 0.2 s that one sample a pixel takes.
"""

import itertools
import math
import pathlib
import sys
import time

import numpy
import OpenEXR
import peer
import scenes

try:
    import bpy
    import mathutils
except ImportError as error:
    sys.exit(f"Cycles is missing ({error}): pip install 'bpy==4.5.*', which needs Python 3.11")

# Half the edge of the square that stands for the endless ground, in scene units.
GROUND = 10000.0
# Quads of a sphere, around and from pole to pole, shaded smooth: a 30th of a pixel off the largest.
SPHERE = {"segments": 96, "ring_count": 48}
# A focal length is in millimetres, and a scene unit is a metre.
MILLIMETRE = 1e-3
FILM_HEIGHT = 24.0  # mm


class Nodes:
    """A shader's nodes: node() makes one and sets its inputs, from constants or other outputs."""

    def __init__(self, owner):
        owner.use_nodes = True
        self.tree = owner.node_tree
        self.tree.nodes.clear()

    def node(self, kind, inputs, **properties):
        node = self.tree.nodes.new(kind)
        for key, value in properties.items():
            setattr(node, key, value)
        for key, value in inputs.items():
            if isinstance(value, bpy.types.NodeSocket):
                self.tree.links.new(value, node.inputs[key])
            else:
                node.inputs[key].default_value = value
        return node

    def math(self, operation, *values):
        inputs = dict(enumerate(values))
        return self.node("ShaderNodeMath", inputs, operation=operation).outputs[0]


def rgba(color):
    return [*color, 1.0]


def color_of(nodes, color):
    """A colour, or the output of Cycles' checker texture, which is one in space too."""
    if not isinstance(color, scenes.Checker):
        return rgba(color)
    place = nodes.node("ShaderNodeNewGeometry", {}).outputs["Position"]
    shifted = nodes.node(
        "ShaderNodeVectorMath", {0: place, 1: [scenes.CHECKER_SHIFT] * 3}, operation="SUBTRACT"
    ).outputs[0]
    inputs = {"Vector": shifted, "Scale": 1 / color.size}
    inputs |= {"Color1": rgba(color.odd), "Color2": rgba(color.even)}
    return nodes.node("ShaderNodeTexChecker", inputs).outputs["Color"]


def material(name, look, ambient):
    """Cycles has no Phong lobe, so highlights are left out; emission stands for ambient light."""
    result = bpy.data.materials.new(name)
    # Glowing surfaces are seen, never aimed at.
    result.cycles.emission_sampling = "NONE"
    nodes = Nodes(result)
    if look.kind == "mirror":
        inputs = {"Color": rgba(look.scaled(look.kr)), "Roughness": 0.0}
        shader = nodes.node("ShaderNodeBsdfAnisotropic", inputs)
    elif look.kind == "emissive":
        inputs = {"Color": rgba(look.color), "Strength": look.radiance}
        shader = nodes.node("ShaderNodeEmission", inputs)
    else:
        glow = look.scaled(scenes.times(ambient, look.ka))
        emission = nodes.node("ShaderNodeEmission", {"Color": color_of(nodes, glow)})
        reflectance = color_of(nodes, look.scaled(look.kd))
        diffuse = nodes.node("ShaderNodeBsdfDiffuse", {"Color": reflectance})
        both = {0: emission.outputs[0], 1: diffuse.outputs[0]}
        shader = nodes.node("ShaderNodeAddShader", both)
    nodes.node("ShaderNodeOutputMaterial", {"Surface": shader.outputs[0]})
    return result


def add(name, data):
    result = bpy.data.objects.new(name, data)
    bpy.context.scene.collection.objects.link(result)
    return result


def shape(scene, number, kind, keys, materials):
    if kind == "sphere":
        bpy.ops.mesh.primitive_uv_sphere_add(
            **SPHERE, radius=keys["radius"], location=keys["center"]
        )
        bpy.ops.object.shade_smooth()
        result = bpy.context.object
    elif kind == "mesh":
        bpy.ops.wm.obj_import(
            filepath=str(scene.path.parent / keys["file"]), forward_axis="NEGATIVE_Z", up_axis="Y"
        )
        result = bpy.context.object
        result.rotation_euler = (0, 0, 0)  # with the file's own axes
    else:
        polygons = [keys.get("vertices")]
        if kind == "plane":
            a = GROUND
            polygons = [[[-a, 0, -a], [-a, 0, a], [a, 0, a], [a, 0, -a]]]
        elif kind == "box":
            polygons = [corners for *_, corners in scenes.box_faces(keys["lower"], keys["upper"])]
        ends = list(itertools.accumulate(len(polygon) for polygon in polygons))
        faces = [
            range(end - len(polygon), end) for polygon, end in zip(polygons, ends, strict=True)
        ]
        vertices = list(itertools.chain(*polygons))
        data = bpy.data.meshes.new(f"shape{number}")
        data.from_pydata(vertices, [], faces)
        result = add(f"shape{number}", data)
    # Cycles follows a diffuse ray even of the last bounce, to whatever glows.
    result.visible_diffuse = False
    result.data.materials.clear()
    result.data.materials.append(materials[keys["material"]])


def light(number, light):
    """A sun's strength is its irradiance; a lamp's is made not to weaken with distance."""
    name = f"light{number}"
    data = bpy.data.lights.new(name, "SUN" if light.directional else "POINT")
    strength = max(light.radiance)
    data.color = [x / strength for x in light.radiance]
    result = add(name, data)
    data.cycles.cast_shadow = light.shadows
    if light.directional:
        data.energy, data.angle = strength, 0.0
        # It shines along its own -z.
        towards = mathutils.Vector(light.vector)
        result.rotation_euler = towards.to_track_quat("Z", "Y").to_euler()
    else:
        # The watts with which a lamp's strength is what it gives at any distance.
        data.energy, data.shadow_soft_size = 4 * math.pi, 0.0
        result.location = light.vector
        nodes = Nodes(data)
        falloff = nodes.node("ShaderNodeLightFalloff", {"Strength": strength})
        emission = nodes.node("ShaderNodeEmission", {"Strength": falloff.outputs["Constant"]})
        nodes.node("ShaderNodeOutputLight", {"Surface": emission.outputs[0]})


def sky(scene):
    """horizon + (zenith - horizon) * h (2 - h), seen by camera and mirrors; it lights nothing."""
    world = bpy.data.worlds.new("sky")
    bpy.context.scene.world = world
    world.cycles.sampling_method = "NONE"
    world.cycles_visibility.diffuse = False
    nodes = Nodes(world)
    color = rgba(scene.horizon)
    if scene.horizon != scene.zenith:
        direction = nodes.node("ShaderNodeTexCoord", {}).outputs["Generated"]
        y = nodes.node("ShaderNodeSeparateXYZ", {0: direction}).outputs["Y"]
        height = nodes.math("MAXIMUM", y, 0.0)
        share = nodes.math("MULTIPLY", height, nodes.math("SUBTRACT", 2.0, height))
        inputs = {"Fac": share, "Color1": rgba(scene.horizon), "Color2": rgba(scene.zenith)}
        color = nodes.node("ShaderNodeMixRGB", inputs).outputs[0]
    background = nodes.node("ShaderNodeBackground", {"Color": color})
    nodes.node("ShaderNodeOutputWorld", {"Surface": background.outputs[0]})


def camera(camera):
    data = bpy.data.cameras.new("camera")
    result = add("camera", data)
    result.location = camera.eye
    w = mathutils.Vector(-camera.forward())
    u = mathutils.Vector(camera.up).cross(w).normalized()
    result.rotation_euler = mathutils.Matrix((u, w.cross(u), w)).transposed().to_euler()
    data.sensor_fit, data.sensor_height = "VERTICAL", FILM_HEIGHT
    data.lens = FILM_HEIGHT / 2 / math.tan(camera.vfov / 2)
    data.clip_start, data.clip_end = 1e-3, 1e6
    data.dof.use_dof, data.dof.focus_distance = True, camera.focal_distance
    data.dof.aperture_fstop = data.lens * MILLIMETRE / camera.lens_diameter
    bpy.context.scene.camera = result


def set_up(scene, job):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    target = bpy.context.scene
    target.render.engine = "CYCLES"
    target.render.use_persistent_data = True
    target.render.threads_mode, target.render.threads = "FIXED", job["threads"]
    target.render.image_settings.file_format = "OPEN_EXR"
    target.render.image_settings.color_depth = "32"
    cycles = target.cycles
    cycles.device = "CPU"
    cycles.seed = job["seed"]
    cycles.use_adaptive_sampling = cycles.use_denoising = False
    cycles.pixel_filter_type, cycles.filter_width = "BOX", 1.0
    # With it lamps that do not weaken with distance are hardly ever chosen, and then glare.
    cycles.use_light_tree = False
    # Mirrors only: no light from surface to surface otherwise.
    cycles.max_bounces = cycles.glossy_bounces = scene.max_bounces
    cycles.diffuse_bounces = cycles.transmission_bounces = cycles.volume_bounces = 0
    cycles.caustics_reflective = cycles.caustics_refractive = False
    camera(scene.camera)
    sky(scene)
    for number, each in enumerate(scene.lights):
        light(number, each)
    materials = {name: material(name, m, scene.ambient) for name, m in scene.materials.items()}
    for number, (kind, keys) in enumerate(scene.shapes):
        shape(scene, number, kind, keys, materials)
    return target


def prepare(job):
    target = set_up(scenes.load(job["scene"]), job)
    picture = pathlib.Path(job["folder"]) / "cycles.exr"

    target.render.resolution_x, target.render.resolution_y = job["size"]

    def timed(samples):
        target.cycles.samples = samples
        # Blender does not see by itself that a kept scene is to be rendered with other settings.
        target.update_tag()
        start = time.perf_counter()
        bpy.ops.render.render()
        return time.perf_counter() - start

    def render(samples):
        seconds = timed(samples)
        bpy.data.images["Render Result"].save_render(str(picture))
        with OpenEXR.File(str(picture), separate_channels=True) as exr:
            channels = exr.channels()
            return seconds, numpy.stack([channels[name].pixels for name in "RGB"], axis=-1)

    # Builds the tree and all else that is kept.
    timed(1)
    return f"Cycles of Blender {bpy.app.version_string}, CPU", render


if __name__ == "__main__":
    peer.main(prepare)
