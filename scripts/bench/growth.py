#!/usr/bin/env python3
"""Prints how the time of a frame grows with pixels, samples, triangles, nodes, lights and materials: a
row a size, and the exponent between the last two sizes. It asserts nothing.

    scripts/bench/growth.py [--large] [KINORA_RENDER [WORD...]]
    scripts/bench/growth.py --moving [KINORA_RENDER]  # what a frame's update costs where 1 % of the
                                                      # nodes move, by the sizes 1 to 10,000: a table, .csv and .svg
                                                      # for docs/trade.md

The scenes are a field of squares seen from above. Times are those of building the scene and
of its first frame on one thread (`--stats=json`), the least of five runs. WORD: rows whose names hold it.
--large adds ten million triangles, whose file has 600 MB.
"""
import json
import math
import pathlib
import statistics
import subprocess
import sys
import tempfile

RUNS = 5


def sheet(triangles):
    """Two sources and the corners of a wavy square of so many triangles, 1 by 1."""
    n = max(1, round(math.sqrt(triangles / 2)))
    points = " ".join(f"{x / n:.6g} {y / n:.6g} {0.02 * math.sin(9 * x / n + 7 * y / n):.4g}"
                      for y in range(n + 1) for x in range(n + 1))
    corners = " ".join(f"{a} {a + 1} {a + n + 1} {a + n + 1} {a + 1} {a + n + 2}"
                       for y in range(n) for a in range(y * (n + 1), y * (n + 1) + n))
    return (n + 1) ** 2, points, 2 * n * n, corners


def field(lights=1, materials=1, nodes=1, reach=None, spot=None, triangles=2):
    """A COLLADA text: `nodes` squares in a grid that all together measure 10 by 10. Lights have
    half their strength at `reach`; spots light circles of the radius `spot`."""
    vertices, points, faces, corners = sheet(triangles)
    kind, cone = "point", ""
    if spot is not None:
        kind = "spot"
        cone = f"<falloff_angle>{2 * math.degrees(math.atan(spot)):.6g}</falloff_angle>"
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
            f'<library_lights><light id="lamp"><technique_common><{kind}><color>'
            f'{1 / lights:.6g} {1 / lights:.6g} {1 / lights:.6g}</color>{fade}{cone}</{kind}>'
            '</technique_common></light></library_lights><library_effects>']
    for m in range(materials):
        text.append(f'<effect id="fx{m}"><profile_COMMON><technique sid="t"><lambert><diffuse>'
                    f'<color>{0.2 + 0.6 * m / materials:.4g} 0.5 0.5 1</color></diffuse></lambert>'
                    '</technique></profile_COMMON></effect>')
    text.append('</library_effects><library_materials>')
    text += [f'<material id="m{m}"><instance_effect url="#fx{m}"/></material>'
             for m in range(materials)]
    text.append('</library_materials><library_geometries><geometry id="g"><mesh><source id="p">'
                f'<float_array id="pa" count="{3 * vertices}">{points}</float_array>'
                f'<technique_common><accessor source="#pa" count="{vertices}" stride="3">'
                '<param name="X" type="float"/><param name="Y" type="float"/><param name="Z" '
                'type="float"/></accessor></technique_common></source><vertices id="v"><input '
                f'semantic="POSITION" source="#p"/></vertices><triangles count="{faces}" '
                'material="s"><input semantic="VERTEX" source="#v" offset="0"/>'
                f'<p>{corners}</p></triangles>'
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


def moving(nodes):
    """The field of which one node in a hundred moves, evenly spread; at least one."""
    text = field(nodes=nodes)
    step = min(100, nodes)
    parts = text.split("<node><translate>")
    first = len(parts) - nodes  # the camera and the light come before
    channels = []
    for n in range(0, nodes, step):
        at = first + n
        parts[at] = parts[at].replace("</translate>", f'</translate><translate sid="m{n}">0 0 0</translate>', 1)
        parts[at - 1] += f'<node id="n{n}"><translate>'
        channels.append(
            f'<animation id="a{n}"><source id="a{n}-i"><float_array id="a{n}-ia" count="2">0 9</float_array><technique_common>'
            f'<accessor source="#a{n}-ia" count="2" stride="1"><param name="TIME" type="float"/></accessor></technique_common>'
            f'</source><source id="a{n}-o"><float_array id="a{n}-oa" count="2">0 0.5</float_array><technique_common>'
            f'<accessor source="#a{n}-oa" count="2" stride="1"><param name="Z" type="float"/></accessor></technique_common>'
            f'</source><source id="a{n}-k"><Name_array id="a{n}-ka" count="2">LINEAR LINEAR</Name_array><technique_common>'
            f'<accessor source="#a{n}-ka" count="2" stride="1"><param name="INTERPOLATION" type="name"/></accessor>'
            f'</technique_common></source><sampler id="a{n}-s"><input semantic="INPUT" source="#a{n}-i"/>'
            f'<input semantic="OUTPUT" source="#a{n}-o"/><input semantic="INTERPOLATION" source="#a{n}-k"/></sampler>'
            f'<channel source="#a{n}-s" target="n{n}/m{n}.Z"/></animation>')
    joined = parts[0]
    for part in parts[1:]:
        joined += part if joined.endswith('"><translate>') else "<node><translate>" + part
    return joined.replace("<library_visual_scenes>",
                          f"<library_animations>{''.join(channels)}</library_animations><library_visual_scenes>", 1)


STAGES = ("animate", "skin", "refit")  # all that a frame does before its first ray, but for the camera


def update_ms(program, scene):
    """Each stage's median over frames that all move; wall clock on one thread."""
    out = subprocess.run([program, scene, "--size", "1x1", "--spp", "1", "--threads", "1", "--frames", "2-61", "-o", "null",
                          "--stats=json", "-q"], check=True, capture_output=True, text=True).stdout
    frames = json.loads(out)["frames"]
    return [statistics.median(frame[f"{stage}_ms"] for frame in frames) for stage in STAGES]


def plot(rows, file):
    """Logarithmic: ms against nodes, the sum of the stages."""
    width, height, left, top, decades_x, decades_y = 420, 260, 50, 14, 4, 4
    y0 = min(0.001, min(sum(ms) for _, ms in rows))
    def at(nodes, ms):
        x = left + math.log10(nodes) / decades_x * (width - left - 30)
        return x, top + (1 - (math.log10(ms) - math.log10(y0)) / decades_y) * (height - top - 36)
    def line(points, style):
        text = " ".join(f"{x:.1f},{y:.1f}" for x, y in points)
        return f'<polyline points="{text}" fill="none" {style}/>'
    parts = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" font-family="sans-serif" '
             f'font-size="11"><rect width="{width}" height="{height}" fill="white"/>']
    for d in range(decades_x + 1):
        x = at(10 ** d, y0)[0]
        parts.append(f'<line x1="{x:.1f}" x2="{x:.1f}" y1="{top}" y2="{height - 36}" stroke="#ddd"/>'
                     f'<text x="{x:.1f}" y="{height - 22}" text-anchor="middle">{10 ** d:,}</text>')
    for d in range(decades_y + 1):
        y = at(1, y0 * 10 ** d)[1]
        parts.append(f'<line x1="{left}" x2="{width - 30}" y1="{y:.1f}" y2="{y:.1f}" stroke="#ddd"/>'
                     f'<text x="{left - 5}" y="{y + 4:.1f}" text-anchor="end">{y0 * 10 ** d:.3g}</text>')
    parts.append(line([at(n, sum(ms)) for n, ms in rows], 'stroke="#c33" stroke-width="2"'))
    parts += [f'<circle cx="{at(n, sum(ms))[0]:.1f}" cy="{at(n, sum(ms))[1]:.1f}" r="3" fill="#c33"/>' for n, ms in rows]
    parts.append(f'<text x="{width / 2}" y="{height - 6}" text-anchor="middle">nodes, of which 1 % move; ms of a '
                 "frame's update</text></svg>")
    file.write_text("\n".join(parts) + "\n")


def measure_moving(program):
    root = pathlib.Path(__file__).resolve().parents[2]
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        scene = pathlib.Path(folder) / "s.dae"
        for nodes in (1, 10, 100, 1000, 10000):
            scene.write_text(moving(nodes))
            rows.append((nodes, update_ms(program, str(scene))))
    lines = ["| nodes | that move | animate, ms | transform and pose, ms | refit, ms | sum |", "|---|---|---|---|---|---|"]
    for nodes, ms in rows:
        lines.append(f"| {nodes:,} | {max(1, nodes // 100)} | " + " | ".join(f"{x:.4f}" for x in ms) + f" | {sum(ms):.4f} |")
    print("\n".join(lines))
    table = "".join(f"{nodes},{max(1, nodes // 100)}," + ",".join(f"{x:.4f}" for x in ms) + "\n" for nodes, ms in rows)
    (root / "docs/images/growth_moving.csv").write_text("nodes,moving," + ",".join(f"{s}_ms" for s in STAGES) + "\n" + table)
    plot(rows, root / "docs/images/growth_moving.svg")
    page = root / "docs/trade.md"
    begin, end = "<!-- measured by scripts/bench/growth.py --moving -->\n", "<!-- end of what moves -->"
    text = page.read_text()
    page.write_text(text[:text.index(begin) + len(begin)] + "\n" + "\n".join(lines) +
                    "\n\n![ms of a frame's update against nodes](images/growth_moving.svg)\n\n" + text[text.index(end):])


def frame_seconds(program, scene, size="160x120", samples=1):
    """Of building the scene, its tree included, and of its first frame. Reading is no part of it: it
    takes longer than the frame where the scene is large, and a difference of two runs would be its noise."""
    command = [program, scene, "--size", size, "--spp", str(samples), "--threads", "1", "-q", "-o", "null",
               "--stats=json"]

    def once():
        stats = json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)
        return (stats["build_ms"] + stats["frames"][0]["total_ms"]) / 1000

    return min(once() for _ in range(RUNS))


# A row: sizes, the scene of a size, what the program is told of it.
THOUSAND = (1, 10, 100, 1000)
GROWS = {
    "pixels": ((1, 10, 100, 1000), lambda n: field(nodes=100),
               lambda n: {"size": f"{round(40 * math.sqrt(n))}x{round(30 * math.sqrt(n))}"}),
    "samples": ((1, 4, 16, 64), lambda n: field(nodes=100), lambda n: {"samples": n}),
    "triangles": ((10 ** 3, 10 ** 4, 10 ** 5, 10 ** 6), lambda n: field(triangles=n), None),
    "nodes": (THOUSAND + (10000,), lambda n: field(nodes=n), None),
    "lights, a point each": (THOUSAND, lambda n: field(lights=n), None),
    "lights that fade": (THOUSAND, lambda n: field(lights=n, reach=10 / math.sqrt(n)), None),
    "lights with cones": (THOUSAND, lambda n: field(lights=n, spot=5 / math.sqrt(n)), None),
    "materials, 1000 nodes": (THOUSAND, lambda n: field(materials=n, nodes=1000), None),
}


def main():
    words = [a for a in sys.argv[1:] if not a.startswith("--")]
    program = words[0] if words else "kinora-render"
    if "--moving" in sys.argv:
        return measure_moving(program)
    if "--large" in sys.argv:
        sizes, *rest = GROWS["triangles"]
        GROWS["triangles"] = (sizes + (10 ** 7,), *rest)
    with tempfile.TemporaryDirectory() as folder:
        scene = str(pathlib.Path(folder) / "s.dae")
        for name, (sizes, make, told) in GROWS.items():
            if words[1:] and not any(word in name for word in words[1:]):
                continue
            times = []
            for size in sizes:
                pathlib.Path(scene).write_text(make(size))
                options = told(size) if told else {}
                times.append(max(frame_seconds(program, scene, **options), 1e-4))
            exponent = math.log(times[-1] / times[-2]) / math.log(sizes[-1] / sizes[-2])
            print(f"{name:24}", *(f"{n}: {1000 * t:.1f} ms" for n, t in zip(sizes, times)),
                  f"exponent {exponent:.2f}", sep="  ", flush=True)


if __name__ == "__main__":
    main()
