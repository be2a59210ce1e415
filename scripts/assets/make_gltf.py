#!/usr/bin/env -S blender -b -P
"""scripts/assets/make_gltf.py: assets/gltf/bender.glb, and where Blender itself has its vertices.

blender -b --factory-startup -P scripts/assets/make_gltf.py -- assets/gltf
A post bends on three bones and breathes by two shape keys; a box beside it turns on curves; a camera
and a sun look on. bender.json holds the world places of all vertices at some frames as Blender's own
evaluation gives them, in glTF's axes (y up): the oracle of tests/runtime/scene/gltf/import_gltf_blender_test.cpp.
"""
import json
import math
import os
import sys

import bpy

OUT = sys.argv[sys.argv.index("--") + 1]
FPS, FRAMES = 24, (1, 7, 13, 20, 25, 37, 49)


def clear():
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.context.scene.render.fps = FPS
    bpy.context.scene.frame_start, bpy.context.scene.frame_end = FRAMES[0], FRAMES[-1]


def material(name, color, metallic, roughness):
    m = bpy.data.materials.new(name)
    m.use_nodes = True
    node = m.node_tree.nodes["Principled BSDF"]
    node.inputs["Base Color"].default_value = (*color, 1)
    node.inputs["Metallic"].default_value = metallic
    node.inputs["Roughness"].default_value = roughness
    return m


def post():
    """A square post of 12 slices from z = 0 to 3."""
    slices, half = 12, 0.3
    vertices, faces = [], []
    for k in range(slices + 1):
        z = 3 * k / slices
        vertices += [(-half, -half, z), (half, -half, z), (half, half, z), (-half, half, z)]
    for k in range(slices):
        for i in range(4):
            j = (i + 1) % 4
            faces.append((4 * k + i, 4 * k + j, 4 * k + 4 + j, 4 * k + 4 + i))
    faces += [(3, 2, 1, 0), tuple(4 * slices + i for i in range(4))]
    mesh = bpy.data.meshes.new("post")
    mesh.from_pydata(vertices, [], faces)
    mesh.materials.append(material("clay", (0.8, 0.3, 0.15), 0.0, 0.6))
    thing = bpy.data.objects.new("post", mesh)
    bpy.context.collection.objects.link(thing)
    return thing


def bones(thing):
    rig = bpy.data.objects.new("rig", bpy.data.armatures.new("rig"))
    bpy.context.collection.objects.link(rig)
    bpy.context.view_layer.objects.active = rig
    bpy.ops.object.mode_set(mode="EDIT")
    parent = None
    for k in range(3):
        bone = rig.data.edit_bones.new(f"bone{k}")
        bone.head, bone.tail = (0, 0, k), (0, 0, k + 1)
        bone.parent = parent
        parent = bone
    bpy.ops.object.mode_set(mode="OBJECT")
    for k in range(3):
        group = thing.vertex_groups.new(name=f"bone{k}")
        for v in thing.data.vertices:
            weight = max(0.0, 1 - abs(v.co.z - (k + 0.5)))
            if k == 0:
                weight = max(weight, 1.0 if v.co.z < 0.5 else 0.0)
            if k == 2:
                weight = max(weight, 1.0 if v.co.z > 2.5 else 0.0)
            if weight > 0:
                group.add([v.index], weight, "REPLACE")
    modifier = thing.modifiers.new("rig", "ARMATURE")
    modifier.object = rig
    thing.parent = rig
    rig.location = (0.5, 0, 0.25)
    rig.rotation_euler = (0, 0, 0.5)
    for frame, angle in ((1, 0.0), (25, 0.9), (49, -0.6)):
        for k in (1, 2):
            bone = rig.pose.bones[f"bone{k}"]
            bone.rotation_mode = "QUATERNION"
            bone.rotation_quaternion = (math.cos(angle / 2), math.sin(angle / 2) * 0.8, 0,
                                        math.sin(angle / 2) * 0.6)
            bone.keyframe_insert("rotation_quaternion", frame=frame)
    return rig


def breath(thing):
    thing.shape_key_add(name="Basis")
    wide, tall = thing.shape_key_add(name="wide"), thing.shape_key_add(name="tall")
    for v in thing.data.vertices:
        bulge = math.sin(math.pi * v.co.z / 3)
        wide.data[v.index].co.x = v.co.x * (1 + 0.8 * bulge)
        wide.data[v.index].co.y = v.co.y * (1 + 0.8 * bulge)
        tall.data[v.index].co.z = v.co.z * 1.2
    for frame, w, t in ((1, 0.0, 0.0), (20, 1.0, 0.25), (49, 0.2, 1.0)):
        wide.value, tall.value = w, t
        wide.keyframe_insert("value", frame=frame)
        tall.keyframe_insert("value", frame=frame)


def box():
    bpy.ops.mesh.primitive_cube_add(size=0.8, location=(-1.4, 0.3, 0.6))
    thing = bpy.context.object
    thing.name = "box"
    thing.data.materials.append(material("brass", (0.9, 0.7, 0.3), 1.0, 0.35))
    thing.rotation_mode = "QUATERNION"
    thing.scale = (1, 0.7, 1.3)
    for frame, angle, z in ((1, 0.0, 0.6), (25, 1.8, 1.6), (49, 3.0, 0.6)):
        thing.rotation_quaternion = (math.cos(angle / 2), 0, math.sin(angle / 2) * 0.6,
                                     math.sin(angle / 2) * 0.8)
        thing.location.z = z
        thing.keyframe_insert("rotation_quaternion", frame=frame)
        thing.keyframe_insert("location", frame=frame)
    return thing


def eye_and_sun():
    bpy.ops.object.camera_add(location=(0.2, -9, 2.2), rotation=(math.radians(86), 0, 0))
    bpy.context.scene.camera = bpy.context.object
    bpy.context.object.data.lens = 42
    bpy.ops.object.light_add(type="SUN", rotation=(0.7, 0.35, 0.2))
    bpy.context.object.data.energy = 3
    bpy.ops.object.light_add(type="POINT", location=(-3, -3, 4))
    bpy.context.object.data.energy = 300


def places(things):
    result = []
    for frame in FRAMES:
        bpy.context.scene.frame_set(frame)
        graph = bpy.context.evaluated_depsgraph_get()
        of_frame = {}
        for thing in things:
            seen = thing.evaluated_get(graph)
            points = [seen.matrix_world @ v.co for v in seen.data.vertices]
            of_frame[thing.name] = [[round(p.x, 6), round(p.z, 6), round(-p.y, 6)] for p in points]
        result.append({"time": frame / FPS, "places": of_frame})
    return result


clear()
thing = post()
bones(thing)
breath(thing)
other = box()
eye_and_sun()
data = places([thing, other])
bpy.ops.export_scene.gltf(filepath=os.path.join(OUT, "bender.glb"), export_format="GLB",
                          export_cameras=True, export_lights=True, export_animations=True,
                          export_force_sampling=True, export_frame_range=True)
with open(os.path.join(OUT, "bender.json"), "w") as file:
    file.write("[\n" + ",\n".join(json.dumps(d, separators=(",", ":")) for d in data) + "\n]\n")
