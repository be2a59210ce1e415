"""tests/programs/convert/blender_glb.py: run by blender: `blender -b -P this -- WIDTH HEIGHT (GLB SECONDS PNG)...`
imports each .glb and renders its first camera with Cycles, transparent where nothing is."""
import sys

import bpy
import numpy

# Debian 12's importer uses a name that its numpy no longer has.
if not hasattr(numpy, "bool"):
    numpy.bool = bool

words = sys.argv[sys.argv.index("--") + 1:]
width, height = int(words[0]), int(words[1])
for glb, seconds, png in zip(words[2::3], words[3::3], words[4::3]):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.import_scene.gltf(filepath=glb)
    scene = bpy.context.scene
    if scene.camera is None:
        scene.camera = next(o for o in scene.objects if o.type == "CAMERA")
    frame = float(seconds) * scene.render.fps / scene.render.fps_base
    scene.frame_set(int(frame), subframe=frame - int(frame))
    scene.render.engine = "CYCLES"
    scene.cycles.samples = 4
    scene.cycles.use_denoising = False
    scene.cycles.max_bounces = 0
    scene.render.threads_mode, scene.render.threads = "FIXED", 2
    scene.render.resolution_x, scene.render.resolution_y = width, height
    scene.render.film_transparent = True
    scene.render.image_settings.file_format = "PNG"
    scene.render.image_settings.color_mode = "RGBA"
    scene.render.filepath = png
    bpy.ops.render.render(write_still=True)
