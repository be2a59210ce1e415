#!/usr/bin/env python3
"""Prints how the time of a frame grows with the number of lights, materials and nodes of a scene: a
row a size, and the exponent between the last two. It asserts nothing.

    scripts/bench/growth.py [KINORA_RENDER [FOLDER]]

The scenes are a field of squares seen from above. Times are the CPU time of a run less that of a
run that only loads (`--list lights`), the least of three.
"""
import math
import pathlib
import resource
import subprocess
import sys
import tempfile

SIZES = (1, 10, 100, 1000)
RUNS = 3


def field(lights=1, materials=1, nodes=1, reach=None):
    """A COLLADA text: `nodes` squares in a grid that all together measure 10 by 10. Lights have
    half their strength at `reach`."""
    side = math.ceil(math.sqrt(nodes))
    step = 10 / side
    spread = math.ceil(math.sqrt(lights))
    fade = "" if reach is None else (f"<quadratic_attenuation>{1 / reach ** 2:.6g}"
                                     "</quadratic_attenuation>")
    text = ['<?xml version="1.0"?><COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" '
            'version="1.4.1"><asset><created>2026-11-23T00:00:00Z</created>'
            '<modified>2026-11-23T00:00:00Z</modified><up_axis>Z_UP</up_axis></asset>'
            '<library_cameras><camera id="eye"><optics><technique_common><perspective>'
            '<yfov>50</yfov><znear>0.1</znear><zfar>100</zfar></perspective></technique_common>'
            '</optics></camera></library_cameras>'
            f'<library_lights><light id="lamp"><technique_common><point><color>'
            f'{1 / lights:.6g} {1 / lights:.6g} {1 / lights:.6g}</color>{fade}</point>'
            '</technique_common></light></library_lights><library_effects>']
    for m in range(materials):
        text.append(f'<effect id="fx{m}"><profile_COMMON><technique sid="t"><lambert><diffuse>'
                    f'<color>{0.2 + 0.6 * m / materials:.4g} 0.5 0.5 1</color></diffuse></lambert>'
                    '</technique></profile_COMMON></effect>')
    text.append('</library_effects><library_materials>')
    text += [f'<material id="m{m}"><instance_effect url="#fx{m}"/></material>'
             for m in range(materials)]
    text.append('</library_materials><library_geometries><geometry id="g"><mesh><source id="p">'
                '<float_array id="pa" count="12">0 0 0 1 0 0 1 1 0 0 1 0</float_array>'
                '<technique_common><accessor source="#pa" count="4" stride="3"><param name="X" '
                'type="float"/><param name="Y" type="float"/><param name="Z" type="float"/>'
                '</accessor></technique_common></source><vertices id="v"><input '
                'semantic="POSITION" source="#p"/></vertices><triangles count="2" material="s">'
                '<input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2 0 2 3</p></triangles>'
                '</mesh></geometry></library_geometries><library_visual_scenes>'
                '<visual_scene id="w"><node><translate>5 5 12</translate>'
                '<instance_camera url="#eye"/></node>')
    for n in range(lights):
        x, y = (n % spread + 0.5) * 10 / spread, (n // spread + 0.5) * 10 / spread
        text.append(f'<node><translate>{x:.5g} {y:.5g} 1</translate>'
                    '<instance_light url="#lamp"/></node>')
    for n in range(nodes):
        x, y = (n % side) * step, (n // side) * step
        text.append(f'<node><translate>{x:.5g} {y:.5g} 0</translate><scale>{step:.5g} {step:.5g} 1'
                    '</scale><instance_geometry url="#g"><bind_material><technique_common>'
                    f'<instance_material symbol="s" target="#m{n % materials}"/>'
                    '</technique_common></bind_material></instance_geometry></node>')
    text.append('</visual_scene></library_visual_scenes><scene><instance_visual_scene url="#w"/>'
                '</scene></COLLADA>')
    return "".join(text)


def cpu_seconds(command):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def frame_seconds(program, scene, picture):
    frame = [program, scene, "--size", "160x120", "--spp", "1", "--threads", "1", "-q",
             "--overwrite", "-o", picture]
    load = [program, scene, "--list", "lights"]
    return (min(cpu_seconds(frame) for _ in range(RUNS)) -
            min(cpu_seconds(load) for _ in range(RUNS)))


GROWS = {
    "lights, a point each": lambda n: field(lights=n),
    "lights that fade": lambda n: field(lights=n, reach=10 / math.sqrt(n)),
    "materials, 1000 nodes": lambda n: field(materials=n, nodes=1000),
    "nodes": lambda n: field(nodes=n),
}


def main():
    program = sys.argv[1] if len(sys.argv) > 1 else "kinora-render"
    with tempfile.TemporaryDirectory(dir=sys.argv[2] if len(sys.argv) > 2 else None) as folder:
        scene, picture = (str(pathlib.Path(folder) / name) for name in ("s.dae", "s.exr"))
        for name, make in GROWS.items():
            times = []
            for size in SIZES:
                pathlib.Path(scene).write_text(make(size))
                times.append(max(frame_seconds(program, scene, picture), 1e-4))
            exponent = math.log(times[-1] / times[-2]) / math.log(SIZES[-1] / SIZES[-2])
            print(f"{name:24}", *(f"{n}: {1000 * t:.1f} ms" for n, t in zip(SIZES, times)),
                  f"exponent {exponent:.2f}", sep="  ", flush=True)


if __name__ == "__main__":
    main()
