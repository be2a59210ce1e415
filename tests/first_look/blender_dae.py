"""tests/first_look/blender_dae.py: run by blender: `blender -b --factory-startup -P this -- FOLDER MODEL...` writes models and Blender's own
scenes by its COLLADA exporter."""
import math
import sys
from pathlib import Path

import bpy
import numpy

sys.path.insert(0, str(Path(__file__).resolve().parent))
import corpus  # noqa: E402
import shapes  # noqa: E402

# Debian 12's exporter uses a name that its numpy no longer has.
if not hasattr(numpy, "bool"):
    numpy.bool = bool
words = sys.argv[sys.argv.index("--") + 1 :]
FOLDER, MODELS = Path(words[0]), words[1:]


def save(name, **options):
    bpy.ops.wm.collada_export(filepath=str(FOLDER / f"{name}.dae"), **options)


def clear(keep=()):
    for thing in list(bpy.data.objects):
        if thing.type not in keep:
            bpy.data.objects.remove(thing)


def material(name, picture=None):
    made = bpy.data.materials.new(name)
    made.diffuse_color = (*corpus.PAINT[name], 1)
    made.use_nodes = True
    shader = made.node_tree.nodes["Principled BSDF"]
    shader.inputs["Base Color"].default_value = (*corpus.PAINT[name], 1)
    if picture:
        image = made.node_tree.nodes.new("ShaderNodeTexImage")
        image.image = bpy.data.images.load(str(picture))
        made.node_tree.links.new(image.outputs["Color"], shader.inputs["Base Color"])
    return made


def model(name, textured, smooth):
    mesh = getattr(shapes, name)()
    data = bpy.data.meshes.new(name)
    data.from_pydata(mesh.points, [], [f for f, _, _ in mesh.faces])
    names = mesh.materials()
    for number, entry in enumerate(names):
        picture = None
        if textured and number == 0:
            corpus.picture(FOLDER / "pictures", f"{name}.png", "brick")
            picture = FOLDER / "pictures" / f"{name}.png"
        data.materials.append(material(entry, picture))
    layer = data.uv_layers.new(name="UVMap")
    at = 0
    for polygon, (_, m, uv) in zip(data.polygons, mesh.faces):
        polygon.material_index = names.index(m)
        polygon.use_smooth = smooth
        for value in uv:
            layer.data[at].uv = value
            at += 1
    data.update()
    thing = bpy.data.objects.new(name, data)
    bpy.context.collection.objects.link(thing)
    return thing


save("startup")  # the cube, a lamp of 1000 W and a camera
bpy.ops.mesh.primitive_monkey_add(location=(0, 0, 1.5))
save("startup_monkey", triangulate=False)
for kind, energy in (("SUN", 3), ("SPOT", 800), ("AREA", 200)):
    for lamp in [o for o in bpy.data.objects if o.type == "LIGHT"]:
        lamp.data.type = kind
        lamp.data.energy = energy
    save(f"monkey_{kind.lower()}")
clear()
save("empty")

for position, name in enumerate(MODELS):
    clear()
    thing = model(name, position % 2 == 0, position % 3 != 0)
    if position % 4 == 1:  # a bone each, and the model bends with it
        armature = bpy.data.objects.new("Armature", bpy.data.armatures.new("Armature"))
        bpy.context.collection.objects.link(armature)
        bpy.context.view_layer.objects.active = armature
        bpy.ops.object.mode_set(mode="EDIT")
        low, high = shapes.Mesh.bounds(getattr(shapes, name)())
        for bone, (a, b) in (
            ("lower", (low[2], (low[2] + high[2]) / 2)),
            ("upper", ((low[2] + high[2]) / 2, high[2])),
        ):
            edit = armature.data.edit_bones.new(bone)
            edit.head, edit.tail = (0, 0, a), (0, 0, b)
        bpy.ops.object.mode_set(mode="OBJECT")
        middle = (low[2] + high[2]) / 2
        for bone, over in (("lower", False), ("upper", True)):
            group = thing.vertex_groups.new(name=bone)
            group.add([v.index for v in thing.data.vertices if (v.co.z > middle) == over], 1.0, "REPLACE")
        thing.parent = armature
        thing.modifiers.new("Armature", "ARMATURE").object = armature
        armature.rotation_euler = (0, 0, math.radians(30))
    if position % 4 == 2:
        lamp = bpy.data.objects.new("Lamp", bpy.data.lights.new("Lamp", "POINT"))
        lamp.data.energy = 1000
        lamp.location = (4, -5, 6)
        bpy.context.collection.objects.link(lamp)
    if position % 4 == 3:
        thing.scale, thing.location = (0.01, 0.01, 0.01), (500, 200, 3)
    save(name, use_texture_copies=position % 3 == 0, triangulate=position % 2 == 0)
