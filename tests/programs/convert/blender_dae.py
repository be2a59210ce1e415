"""tests/programs/convert/blender_dae.py: run by blender: `blender -b -P this -- FOLDER` makes scenes and
writes each as NAME.glb and, by Blender's COLLADA exporter, as NAME.WAY.dae."""
import math
import sys
from pathlib import Path

import bpy
import numpy

# Debian 12's exporter uses a name that its numpy no longer has.
if not hasattr(numpy, "bool"):
    numpy.bool = bool

FOLDER = Path(sys.argv[sys.argv.index("--") + 1])
FRAMES = 25
WAYS = {
    "matrix": {},
    "decomposed": {"export_object_transformation_type_selection": "decomposed",
                   "export_animation_transformation_type_selection": "decomposed"},
    "sampled": {"export_animation_type_selection": "sample", "triangulate": False,
                "keep_bind_info": True},
}


def linked(name, data):
    made = bpy.data.objects.new(name, data)
    bpy.context.collection.objects.link(made)
    return made


def mesh(name, corners, faces):
    data = bpy.data.meshes.new(name)
    data.from_pydata(corners, [], faces)
    data.update()
    return linked(name, data)


def wedge():
    """A block that looks another way from every side, with concave ends."""
    outline = [(-1, -0.5), (1, -0.5), (1, 0.2), (0, 0), (-0.5, 1.5), (-1, 1)]
    n = len(outline)
    return mesh("wedge", [(x, y, z) for z in (-0.4, 0.5) for x, y in outline],
                [tuple(range(n))[::-1], tuple(range(n, 2 * n))] +
                [(i, (i + 1) % n, n + (i + 1) % n, n + i) for i in range(n)])


def keyed(thing, path, keys):
    for frame, value in keys:
        setattr(thing, path, value)
        thing.keyframe_insert(path, frame=frame)


def column(armature):
    """Eight sides, twelve storeys, four units high; the upper half follows the second bone."""
    sides, storeys = 8, 12
    ring = [(0.5 * math.cos(2 * math.pi * k / sides), 0.5 * math.sin(2 * math.pi * k / sides))
            for k in range(sides)]
    faces = [(i * sides + k, i * sides + (k + 1) % sides, (i + 1) * sides + (k + 1) % sides,
              (i + 1) * sides + k) for i in range(storeys) for k in range(sides)]
    # Closed: glTF hides the inside.
    faces += [tuple(range(sides))[::-1], tuple(range(storeys * sides, (storeys + 1) * sides))]
    made = mesh("column", [(x, y, 4 * i / storeys) for i in range(storeys + 1) for x, y in ring], faces)
    groups = [made.vertex_groups.new(name=bone.name) for bone in armature.data.bones]
    for vertex in made.data.vertices:
        upper = min(1, max(0, vertex.co.z - 1.5))
        groups[0].add([vertex.index], 1 - upper, "REPLACE")
        groups[1].add([vertex.index], upper, "REPLACE")
    made.modifiers.new("armature", "ARMATURE").object = armature
    made.parent = armature
    return made


def armature():
    made = linked("rig", bpy.data.armatures.new("rig"))
    bpy.context.view_layer.objects.active = made
    bpy.ops.object.mode_set(mode="EDIT")
    bones = [made.data.edit_bones.new(name) for name in ("lower part", "upper.part")]
    for height, bone in zip((0, 2), bones):
        bone.head, bone.tail = (0, 0, height), (0, 0, height + 2)
    bones[1].parent = bones[0]
    bpy.ops.object.mode_set(mode="OBJECT")
    return made


def moving():
    thing = wedge()
    thing.scale = (1, 0.7, 1.4)
    thing.rotation_euler = (0.2, 0.5, 0.3)
    keyed(thing, "location", [(1, (-1, 0, 0)), (13, (1, 0, 1)), (25, (0, 1, 0))])


def turning():
    keyed(wedge(), "rotation_euler", [(1, (0, 0, 0)), (25, (0, 1, math.pi))])


def still_skin():
    rig = armature()
    rig.location, rig.rotation_euler, rig.scale = (1, 0, -1), (0, 0.4, 0.3), (0.8, 0.8, 0.8)
    column(rig)
    keyed(rig.pose.bones[1], "rotation_quaternion", [(1, (1, 0, 0, 0)), (25, (0.8, 0.6, 0, 0))])


def moved_skin():
    rig = armature()
    column(rig)
    keyed(rig, "location", [(1, (-1, 0, -1)), (25, (2, 1, -1))])


def add_camera():
    camera = linked("eye", bpy.data.cameras.new("eye"))
    camera.location = (6, -8, 4)
    camera.rotation_euler = (-camera.location).to_track_quat("-Z", "Y").to_euler()
    bpy.context.scene.camera = camera


for make in (moving, turning, still_skin, moved_skin):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.render.resolution_x = scene.render.resolution_y = 128
    scene.frame_start, scene.frame_end, scene.render.fps = 1, FRAMES, 24
    make()
    add_camera()
    scene.frame_set(1)
    name = str(FOLDER / make.__name__)
    bpy.ops.export_scene.gltf(filepath=name + ".glb", export_format="GLB", export_cameras=True)
    for way, options in WAYS.items():
        bpy.ops.wm.collada_export(filepath=f"{name}.{way}.dae", **options)
