# scripts/assets/make_walker.py: models, rigs and animates the walking statue and exports COLLADA.
#
#   blender --background --python-exit-code 1 --python scripts/assets/make_walker.py -- OUT.dae
import os
import sys

import bpy

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import walker_gait as gait  # noqa: E402
import walker_rig as rig  # noqa: E402
import walker_set as gallery  # noqa: E402

# What viewers without RSL show; linear.
COLORS = {
    "marble": (0.80, 0.78, 0.74), "stone": (0.62, 0.58, 0.52), "planks": (0.36, 0.20, 0.10),
    "wall": (0.05, 0.16, 0.17), "trim": (0.09, 0.22, 0.22), "sneaker": (0.75, 0.08, 0.04),
    "headphone": (0.75, 0.08, 0.04), "knot": (0.80, 0.42, 0.03), "brass": (0.60, 0.42, 0.14),
}


def materials():
    made = {}
    for name, color in COLORS.items():
        made[name] = bpy.data.materials.new(name)
        made[name].use_nodes = True
        shader = made[name].node_tree.nodes["Principled BSDF"]
        shader.inputs["Base Color"].default_value = (*color, 1)
    return made


def main(path):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.frame_start, scene.frame_end, scene.render.fps = 1, gait.FRAMES, 24
    scene.render.resolution_x, scene.render.resolution_y = 1280, 720
    m = materials()
    armature = rig.build_armature()
    rig.build_statue(armature, m["marble"], 0.0108)
    rig.build_shoes(armature, m["sneaker"], 0.0085)
    rig.build_headphones(armature, m["headphone"], 0.0075)
    rig.key_walk(armature)
    gallery.build_room(m)
    gallery.build_lights()
    gallery.build_camera()
    bpy.context.view_layer.update()
    bpy.ops.wm.collada_export(
        filepath=path, apply_modifiers=False, include_armatures=True, deform_bones_only=False,
        include_animations=True, include_all_actions=False,
        export_animation_type_selection="sample",
        sampling_rate=1,
        export_animation_transformation_type_selection="matrix", keep_flat_curves=True,
        export_object_transformation_type_selection="matrix",
        triangulate=False, use_object_instantiation=True, use_blender_profile=False,
        sort_by_name=True, limit_precision=True)


main(sys.argv[sys.argv.index("--") + 1])
