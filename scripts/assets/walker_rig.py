# scripts/assets/walker_rig.py: Blender's armature of the walker, its skinned meshes and its keys.
import bpy
from mathutils import Matrix

import distance_field as df
import walker_body as wb
import walker_gait as gait


def build_armature():
    armature = bpy.data.armatures.new("walker_rig")
    rig = bpy.data.objects.new("walker_rig", armature)
    bpy.context.collection.objects.link(rig)
    bpy.context.view_layer.objects.active = rig
    bpy.ops.object.mode_set(mode="EDIT")
    for name, (parent, head, tail) in wb.joints().items():
        bone = armature.edit_bones.new(name)
        bone.head, bone.tail = head, tail
        if parent:
            bone.parent = armature.edit_bones[parent]
    bpy.ops.object.mode_set(mode="OBJECT")
    return rig


def skinned_mesh(rig, name, material, points, quads, influences):
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata([tuple(map(float, p)) for p in points], [],
                     [tuple(map(int, q)) for q in quads])
    mesh.polygons.foreach_set("use_smooth", [True] * len(mesh.polygons))
    mesh.materials.append(material)
    thing = bpy.data.objects.new(name, mesh)
    bpy.context.collection.objects.link(thing)
    groups = {joint: thing.vertex_groups.new(name=joint) for joint in wb.joints()}
    for vertex, pairs in enumerate(influences):
        for joint, weight in pairs:
            groups[joint].add([vertex], weight, "REPLACE")
    thing.parent = rig
    thing.modifiers.new("skin", "ARMATURE").object = rig
    return thing


def build_statue(rig, material, cell):
    points, quads = df.surface(wb.body(), (-0.2, -0.68, 0.0), (0.2, 0.68, 1.82), cell)
    influences = wb.weights(points, quads, wb.body_solids())
    skinned_mesh(rig, "statue", material, points, quads, influences)


def build_shoes(rig, material, cell):
    for suffix, m in (("_L", lambda p: tuple(p)), ("_R", wb.mirrored)):
        solids = {name + suffix: solid for name, solid in wb.shoe_solids(m).items()}
        solid = df.join(0.02, *solids.values())
        y = 0.1 if suffix == "_L" else -0.1
        points, quads = df.surface(solid, (-0.12, y - 0.09, -0.02), (0.24, y + 0.09, 0.16), cell)
        skinned_mesh(rig, "sneaker" + suffix, material, points, quads,
                     wb.weights(points, quads, solids, spread=0.012))


def build_headphones(rig, material, cell):
    points, quads = df.surface(wb.headphones(), (-0.1, -0.2, 1.54), (0.08, 0.2, 1.83), cell)
    skinned_mesh(rig, "headphones", material, points, quads, [[("head", 1.0)]] * len(points))


def to_matrix(turn, head):
    m = Matrix([list(map(float, row)) for row in turn]).to_4x4()
    m.translation = head
    return m


def key_walk(rig):
    """Each frame's pose as location and rotation keys. A pose bone's own matrix is relative to
    its rest place under its parent."""
    rest = {bone.name: bone.matrix_local for bone in rig.data.bones}
    for number, pose in enumerate(gait.walk()):
        placed = {}
        for name, (turn, head) in pose.items():
            axes = rest[name].to_3x3().to_4x4()
            placed[name] = to_matrix(turn, head) @ axes
        for bone in rig.pose.bones:
            local_rest, local = rest[bone.name], placed[bone.name]
            if bone.parent:
                local_rest = rest[bone.parent.name].inverted() @ local_rest
                local = placed[bone.parent.name].inverted() @ local
            location, rotation, _ = (local_rest.inverted() @ local).decompose()
            bone.rotation_mode = "QUATERNION"
            bone.rotation_quaternion = rotation
            bone.keyframe_insert("rotation_quaternion", frame=number + 1)
            if bone.name in ("root", "hips"):
                bone.location = location
                bone.keyframe_insert("location", frame=number + 1)
