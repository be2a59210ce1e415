"""Pictures of Blender's Cycles, on one thread, at its default settings but for denoising, adaptive sampling and the filter."""
import json
import os
import re
import subprocess
import sys

BEFORE = """
import json, math, sys, time
import bpy
task, size, runs, bounces, folder = json.loads(sys.argv[sys.argv.index("--") + 1])
bpy.ops.wm.read_factory_settings(use_empty=True)
scene = bpy.context.scene
"""

AFTER = """
scene.render.engine = "CYCLES"
scene.render.resolution_x, scene.render.resolution_y = size
scene.render.resolution_percentage = 100
scene.render.threads_mode, scene.render.threads = "FIXED", 1
scene.render.image_settings.file_format = "OPEN_EXR"
scene.render.image_settings.color_depth = "32"
scene.view_settings.view_transform = "Raw"
scene.cycles.device = "CPU"
for name, value in {"use_denoising": False, "use_adaptive_sampling": False, "max_bounces": bounces,
                    "diffuse_bounces": bounces, "glossy_bounces": bounces, "pixel_filter_type": "BOX"}.items():
    setattr(scene.cycles, name, value)
times = []
for name, samples, seed in runs:
    scene.cycles.samples, scene.cycles.seed = samples, seed
    scene.render.filepath = folder + "/" + name + ".exr"
    before = time.process_time()
    bpy.ops.render.render(write_still=True)
    times.append(time.process_time() - before)
print("CYCLES " + json.dumps(times))
"""


def seconds_of(scene, folder, runs):
    """Renders (name, samples, seed) of each run to folder/name.exr; the seconds of CPU that each took."""
    script = folder / "cycles.py"
    script.write_text(BEFORE + scene.CYCLES + AFTER)
    task = [scene.TASK, scene.SIZE, runs, scene.BOUNCES, str(folder)]
    done = subprocess.run(["blender", "--background", "--factory-startup", "--python", script, "--", json.dumps(task)],
                          capture_output=True, text=True, env=dict(os.environ, HOME=str(folder)))
    found = re.search(r"^CYCLES (.*)$", done.stdout, re.M)
    if not found:
        sys.exit("blender rendered nothing:\n" + (done.stdout + done.stderr)[-2000:])
    return json.loads(found[1])
