"""assets/scenes/atelier.dae for both programs: Blender imports it and gets materials and lamps of the same make."""
from pathlib import Path

SIZE, BOUNCES = (160, 90), 2
FIRST_ROW = 24  # above, lamps are seen, which Cycles does not show
SCENE = Path(__file__).resolve().parent.parent.parent.parent / "assets/scenes/atelier.dae"
# Tint, roughness, metal; two tints: a noise mixes them, as the co-shaders do.
MATERIALS = {
    "floor": [[0.3, 0.19, 0.11], 0.42, 0, [0.5, 0.32, 0.18], 12],
    "wall": [[0.67, 0.64, 0.59], 0.8, 0, [0.82, 0.79, 0.72], 2],
    "wood": [[0.3, 0.17, 0.09], 0.45, 0, None, 0],
    "canvas": [[0.3, 0.36, 0.55], 0.65, 0, [0.9, 0.6, 0.35], 4],
    "glazed": [[0.08, 0.32, 0.36], 0.16, 0, [0.75, 0.83, 0.74], 2],
    "brass": [[0.86, 0.62, 0.26], 0.28, 1, None, 0],
    "lacquer": [[0.5, 0.02, 0.03], 0.13, 0, None, 0],
    "steel": [[0.62, 0.63, 0.65], 0.42, 1, None, 0],
}
# Name of the node that holds its mesh; width, height, radiance.
SOFTBOXES = {"key": [2.4, 1.6, 5.0, [1.0, 0.94, 0.84]], "rim": [0.5, 3.2, 7.0, [0.62, 0.78, 1.0]]}
BULB = [0.16, 42.0, [1.0, 0.72, 0.42]]  # radius, radiance
TASK = [str(SCENE), MATERIALS, SOFTBOXES, BULB, str(SCENE.with_name("atelier_sky.hdr"))]

CYCLES = """
from mathutils import Vector
path, materials, softboxes, (radius, radiance, tint), sky = task
unit = 0.1  # the file's, in metres
bpy.ops.wm.collada_import(filepath=path)
for name, (color, rough, metal, other, detail) in materials.items():
    made = bpy.data.materials[name + "-material"]
    made.use_nodes = True
    tree = made.node_tree
    shader = next(node for node in tree.nodes if node.type == "BSDF_PRINCIPLED")
    shader.inputs["Base Color"].default_value = (*color, 1)
    shader.inputs["Roughness"].default_value, shader.inputs["Metallic"].default_value = rough, metal
    if not other: continue
    noise, mix = tree.nodes.new("ShaderNodeTexNoise"), tree.nodes.new("ShaderNodeMixRGB")
    place = tree.nodes.new("ShaderNodeTexCoord")
    noise.inputs["Scale"].default_value = detail
    mix.inputs["Color1"].default_value, mix.inputs["Color2"].default_value = (*color, 1), (*other, 1)
    tree.links.new(place.outputs["Object"], noise.inputs["Vector"])
    tree.links.new(noise.outputs["Fac"], mix.inputs["Fac"])
    tree.links.new(mix.outputs[0], shader.inputs["Base Color"])
for name, (width, height, power, color) in softboxes.items():
    old = bpy.data.objects[name]
    light = bpy.data.lights.new(name, "AREA")
    light.shape, light.size, light.size_y, light.color = "RECTANGLE", width * unit, height * unit, color
    light.energy = power * math.pi * width * height * unit * unit
    lamp = bpy.data.objects.new(name + "-lamp", light)
    lamp.matrix_world = old.matrix_world.normalized()
    # A grid of ours shines to the side of its normal, a lamp of theirs along -z.
    if (old.matrix_world.to_3x3() @ old.data.polygons[0].normal).dot(lamp.matrix_world.to_3x3() @ Vector((0, 0, -1))) < 0:
        lamp.rotation_mode = "XYZ"
        lamp.matrix_world = lamp.matrix_world @ __import__("mathutils").Matrix.Rotation(math.pi, 4, "X")
    scene.collection.objects.link(lamp)
    bpy.data.objects.remove(old)
bpy.data.objects.remove(bpy.data.objects["ball"])
for item in [o for o in scene.objects if o.type == "LIGHT" and o.name.startswith("bulb")]:
    where = item.matrix_world.translation.copy()
    bpy.data.objects.remove(item)
light = bpy.data.lights.new("bulb", "POINT")
light.shadow_soft_size, light.color = radius * unit, tint
light.energy = radiance * 4 * math.pi ** 2 * (radius * unit) ** 2
bulb = bpy.data.objects.new("bulb", light)
bulb.location = where
scene.collection.objects.link(bulb)
world = scene.world or bpy.data.worlds.new("sky")
scene.world = world
world.use_nodes = True
around = world.node_tree.nodes.new("ShaderNodeTexEnvironment")
around.image = bpy.data.images.load(sky)
ground = world.node_tree.nodes["Background"]
ground.inputs["Strength"].default_value = 0.5
world.node_tree.links.new(around.outputs[0], ground.inputs["Color"])
for item in [o for o in scene.objects if o.type == "CAMERA"]: bpy.data.objects.remove(item)
eye = bpy.data.objects.new("eye", bpy.data.cameras.new("eye"))
eye.location = (-1.2 * unit, -9.6 * unit, 3.9 * unit)
eye.rotation_euler = (Vector((0.5, 0.6, 2.35)) * unit - eye.location).to_track_quat("-Z", "Y").to_euler()
eye.data.angle, eye.data.clip_start = math.radians(46), 0.001
scene.collection.objects.link(eye)
scene.camera = eye
scene.frame_set(0)
"""


def ours(_):
    """The file as it is, by kinora-render."""
    return {"atelier": (SCENE, ["--size", f"{SIZE[0]}x{SIZE[1]}", "--bounces", str(BOUNCES), "--filter", "box", "--frames", "1"])}
