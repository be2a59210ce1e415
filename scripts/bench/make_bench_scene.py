#!/usr/bin/env python3
"""Writes the scene that frame times are measured on: a skinned tube of 70 000 triangles that bends
and twists on ten joints over 24 frames, marble by assets/shaders/marble.sl, one directional light
that casts shadows, a camera whose 4:3 picture it half fills. `dance` bends and twists it eight times as much; `collapse`
lets it fall into a heap of a tenth of its height.

    scripts/bench/make_bench_scene.py bench.dae [dance|collapse]
    kinora-render bench.dae --size 640x480 --spp 1 --math fast --threads 1 --frames 1-10 --stats -o /tmp/bench.#.png
"""
import math
import pathlib
import sys

AROUND, ALONG = 250, 140  # quads: 2 * 250 * 140 = 70 000 triangles
JOINTS = 10
HEIGHT = 4.0
FRAMES, RATE = 24, 24.0


def numbers(values):
    return " ".join(f"{v:.6g}" for v in values)


def source(name, values, stride, params, kind="float"):
    accessor = "".join(f'<param name="{p}" type="{kind}"/>' for p in params)
    return (f'<source id="{name}"><float_array id="{name}-array" count="{len(values)}">'
            f"{numbers(values)}</float_array><technique_common>"
            f'<accessor source="#{name}-array" count="{len(values) // stride}" stride="{stride}">'
            f"{accessor}</accessor></technique_common></source>")


def names(name, values, param, kind="name"):
    return (f'<source id="{name}"><Name_array id="{name}-array" count="{len(values)}">'
            f'{" ".join(values)}</Name_array><technique_common>'
            f'<accessor source="#{name}-array" count="{len(values)}" stride="1">'
            f'<param name="{param}" type="{kind}"/></accessor></technique_common></source>')


def tube():
    """Positions, normals and triangle corners of a wavy tube about the y axis."""
    positions, normals, corners = [], [], []
    for j in range(ALONG + 1):
        y = HEIGHT * j / ALONG
        radius = 0.95 + 0.15 * math.sin(3 * y)
        slope = 0.45 * math.cos(3 * y)
        for i in range(AROUND):
            a = 2 * math.pi * i / AROUND
            positions += [radius * math.cos(a), y, radius * math.sin(a)]
            length = math.sqrt(1 + slope * slope)
            normals += [math.cos(a) / length, -slope / length, math.sin(a) / length]
    for j in range(ALONG):
        for i in range(AROUND):
            a, b = j * AROUND + i, j * AROUND + (i + 1) % AROUND
            c, d = a + AROUND, b + AROUND
            corners += [a, c, b, b, c, d]
    return positions, normals, corners


def influences(positions):
    """Four joints a vertex, weighted by nearness along the tube: vcount, v and weights."""
    counts, pairs, weights = [], [], []
    for y in positions[1::3]:
        at = y / HEIGHT * (JOINTS - 1)
        first = min(max(int(at) - 1, 0), JOINTS - 4)
        near = [max(0.0, 1 - abs(at - j) / 2) for j in range(first, first + 4)]
        counts.append(4)
        for k, weight in enumerate(near):
            pairs += [first + k, len(weights)]
            weights.append(weight / sum(near))
    return counts, pairs, weights


def geometry(positions, normals, corners):
    return (f'<geometry id="tube"><mesh>{source("tube-p", positions, 3, "XYZ")}'
            f'{source("tube-n", normals, 3, "XYZ")}<vertices id="tube-v">'
            '<input semantic="POSITION" source="#tube-p"/><input semantic="NORMAL" source="#tube-n"/>'
            f'</vertices><triangles material="stone" count="{len(corners) // 3}">'
            '<input semantic="VERTEX" source="#tube-v" offset="0"/>'
            f'<p>{" ".join(map(str, corners))}</p></triangles></mesh></geometry>')


def controller(positions):
    counts, pairs, weights = influences(positions)
    step = HEIGHT / (JOINTS - 1)
    inverse_bind = []
    for j in range(JOINTS):
        inverse_bind += [1, 0, 0, 0, 0, 1, 0, -step * j, 0, 0, 1, 0, 0, 0, 0, 1]
    return ('<controller id="skin"><skin source="#tube">'
            f'{names("skin-j", [f"J{j}" for j in range(JOINTS)], "JOINT")}'
            f'{source("skin-b", inverse_bind, 16, ["TRANSFORM"], "float4x4")}'
            f'{source("skin-w", weights, 1, ["WEIGHT"])}'
            '<joints><input semantic="JOINT" source="#skin-j"/>'
            '<input semantic="INV_BIND_MATRIX" source="#skin-b"/></joints>'
            f'<vertex_weights count="{len(counts)}">'
            '<input semantic="JOINT" source="#skin-j" offset="0"/>'
            '<input semantic="WEIGHT" source="#skin-w" offset="1"/>'
            f'<vcount>{" ".join(map(str, counts))}</vcount><v>{" ".join(map(str, pairs))}</v>'
            "</vertex_weights></skin></controller>")


KEYS = 9
# How far joints bend and twist, degrees, and the share of its height that the tube falls.
MOVES = {"": (4, 8, 0), "dance": (32, 64, 0), "collapse": (12, 24, 0.9)}


def swing(joint, transform, angle):
    """One sine of `angle` degrees over the clip."""
    return channel(joint, f"{transform}.ANGLE", "ANGLE",
                   [angle * math.sin(2 * math.pi * k / (KEYS - 1) + 0.5 * joint)
                    for k in range(KEYS)])


def fall(joint, share):
    """The joint comes nearer to the one before."""
    step = HEIGHT / (JOINTS - 1)
    return channel(joint, "place.Y", "Y", [step * (1 - share * k / (KEYS - 1)) for k in range(KEYS)])


def channel(joint, target, param, values):
    """The values over the clip, in linear keys."""
    name = f"J{joint}-{target.split('.')[0]}"
    keys = len(values)
    times = [k * FRAMES / RATE / (keys - 1) for k in range(keys)]
    return (f'<animation id="{name}">{source(name + "-t", times, 1, ["TIME"])}'
            f'{source(name + "-v", values, 1, [param])}'
            f'{names(name + "-i", ["LINEAR"] * keys, "INTERPOLATION")}'
            f'<sampler id="{name}-s"><input semantic="INPUT" source="#{name}-t"/>'
            f'<input semantic="OUTPUT" source="#{name}-v"/>'
            f'<input semantic="INTERPOLATION" source="#{name}-i"/></sampler>'
            f'<channel source="#{name}-s" target="J{joint}/{target}"/></animation>')


def joint_nodes():
    step = HEIGHT / (JOINTS - 1)
    node = ""
    for j in reversed(range(JOINTS)):
        node = (f'<node id="J{j}" sid="J{j}" type="JOINT">'
                f'<translate sid="place">0 {step if j else 0:.6g} 0</translate>'
                '<rotate sid="twist">0 1 0 0</rotate><rotate sid="bend">0 0 1 0</rotate>'
                f"{node}</node>")
    return node


def main():
    marble = pathlib.Path(__file__).resolve().parents[2] / "assets/shaders/marble.sl"
    positions, normals, corners = tube()
    bend, twist, share = MOVES[sys.argv[2] if len(sys.argv) > 2 else ""]
    moves = "".join(swing(j, transform, angle) for j in range(1, JOINTS)
                    for transform, angle in (("bend", bend), ("twist", twist)))
    if share:
        moves += "".join(fall(j, share) for j in range(1, JOINTS))
    text = f"""<?xml version="1.0" encoding="utf-8"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><created>2026-11-21T00:00:00Z</created><modified>2026-11-21T00:00:00Z</modified>
<up_axis>Y_UP</up_axis></asset>
<library_animations>{moves}</library_animations>
<library_cameras><camera id="camera"><optics><technique_common><perspective><yfov>40</yfov>
<aspect_ratio>1.33333</aspect_ratio><znear>0.1</znear><zfar>100</zfar></perspective>
</technique_common></optics></camera></library_cameras>
<library_lights><light id="sun"><technique_common><directional><color>1 1 1</color></directional>
</technique_common></light></library_lights>
<library_effects><effect id="marble"><profile_RSL><technique sid="default"><code><![CDATA[
{marble.read_text()}]]></code><pass><shader stage="SURFACE"/></pass></technique></profile_RSL>
</effect></library_effects>
<library_materials><material id="stone"><instance_effect url="#marble"/></material>
</library_materials>
<library_geometries>{geometry(positions, normals, corners)}</library_geometries>
<library_controllers>{controller(positions)}</library_controllers>
<library_visual_scenes><visual_scene id="scene">{joint_nodes()}
<node id="body"><instance_controller url="#skin"><skeleton>#J0</skeleton><bind_material>
<technique_common><instance_material symbol="stone" target="#stone"/></technique_common>
</bind_material></instance_controller></node>
<node id="view"><translate>0 2 5.6</translate><instance_camera url="#camera"/></node>
<node id="sky"><rotate>0 1 0 50</rotate><rotate>1 0 0 -35</rotate><instance_light url="#sun"/></node>
</visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#scene"/></scene>
</COLLADA>
"""
    pathlib.Path(sys.argv[1]).write_text(text)


if __name__ == "__main__":
    main()
