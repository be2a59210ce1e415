#!/usr/bin/env python3
"""make_big_dae.py OUT.dae [MEGABYTES]: a scene of that size in the manner of exporters.

Meshes with normals and texture coordinates of their own indices (six digits, as Maya and Blender
write), one of them skinned and keyed. For measuring how fast files load; the same bytes each time.
"""
import math
import random
import sys

random.seed(4)


def floats(values):
    return " ".join("%.6g" % v for v in values)


def source(name, values, params):
    entries = len(values) // len(params)
    columns = "".join(f'<param name="{p}" type="float"/>' for p in params)
    return (f'<source id="{name}"><float_array id="{name}-array" count="{len(values)}">'
            f'{floats(values)}</float_array><technique_common><accessor source="#{name}-array" '
            f'count="{entries}" stride="{len(params)}">{columns}</accessor></technique_common>'
            f'</source>\n')


def grid_mesh(name, n):
    """A bumpy sphere of n x n quads."""
    positions, normals, uvs, indices = [], [], [], []
    for j in range(n + 1):
        for i in range(n + 1):
            a, b = 2 * math.pi * i / n, math.pi * j / n
            r = 1 + 0.05 * random.random()
            d = (math.sin(b) * math.cos(a), math.cos(b), math.sin(b) * math.sin(a))
            positions += [r * c for c in d]
            normals += d
            uvs += [i / n, j / n]
    for j in range(n):
        for i in range(n):
            a = j * (n + 1) + i
            for v in (a, a + n + 1, a + 1, a + 1, a + n + 1, a + n + 2):
                indices += [v, v, v]
    return (f'<geometry id="{name}" name="{name}"><mesh>\n{source(name + "-p", positions, "XYZ")}'
            f'{source(name + "-n", normals, "XYZ")}{source(name + "-t", uvs, "ST")}'
            f'<vertices id="{name}-v"><input semantic="POSITION" source="#{name}-p"/></vertices>\n'
            f'<triangles material="m" count="{2 * n * n}"><input semantic="VERTEX" '
            f'source="#{name}-v" offset="0"/><input semantic="NORMAL" source="#{name}-n" offset="1"'
            f'/><input semantic="TEXCOORD" source="#{name}-t" offset="2" set="0"/>\n'
            f'<p>{" ".join(map(str, indices))}</p></triangles></mesh></geometry>\n')


def skin(name, geometry, vertices, joints):
    names = " ".join(f"bone{j}" for j in range(joints))
    binds = [1.0 if k % 5 == 0 else 0.0 for k in range(16)] * joints
    weights = [k / 100 for k in range(101)]
    counts, v = [], []
    for i in range(vertices):
        j, w = random.randrange(joints - 1), random.randrange(101)
        counts.append("2")
        v += [j, w, j + 1, 100 - w]
    return (f'<controller id="{name}"><skin source="#{geometry}"><source id="{name}-j"><Name_array '
            f'id="{name}-ja" count="{joints}">{names}</Name_array><technique_common><accessor '
            f'source="#{name}-ja" count="{joints}" stride="1"><param name="JOINT" type="name"/>'
            f'</accessor></technique_common></source>\n<source id="{name}-m"><float_array '
            f'id="{name}-ma" count="{16 * joints}">{floats(binds)}</float_array><technique_common>'
            f'<accessor source="#{name}-ma" count="{joints}" stride="16"><param name="TRANSFORM" '
            f'type="float4x4"/></accessor></technique_common></source>\n'
            f'{source(name + "-w", weights, ["WEIGHT"])}<joints><input semantic="JOINT" '
            f'source="#{name}-j"/><input semantic="INV_BIND_MATRIX" source="#{name}-m"/></joints>'
            f'<vertex_weights count="{vertices}"><input semantic="JOINT" source="#{name}-j" '
            f'offset="0"/><input semantic="WEIGHT" source="#{name}-w" offset="1"/><vcount>'
            f'{" ".join(counts)}</vcount><v>{" ".join(map(str, v))}</v></vertex_weights></skin>'
            f'</controller>\n')


def animation(joint, keys):
    name = f"turn{joint}"
    times = [k / 24 for k in range(keys)]
    angles = [30 * math.sin(k / 9 + joint) for k in range(keys)]
    return (f'<animation id="{name}">{source(name + "-i", times, ["TIME"])}'
            f'{source(name + "-o", angles, ["ANGLE"])}<sampler id="{name}-s"><input '
            f'semantic="INPUT" source="#{name}-i"/><input semantic="OUTPUT" source="#{name}-o"/>'
            f'</sampler><channel source="#{name}-s" target="bone{joint}/turn.ANGLE"/></animation>\n')


def main():
    path = sys.argv[1]
    size = int(float(sys.argv[2] if len(sys.argv) > 2 else 10) * 1e6)
    joints, skinned = 40, 60
    bones = "".join(f'<node id="bone{j}" sid="bone{j}" type="JOINT"><translate>0 0.1 0</translate>'
                    f'<rotate sid="turn">0 0 1 0</rotate>' for j in range(joints))
    meshes = grid_mesh("skinned", skinned)
    controllers = skin("body", "skinned", (skinned + 1) ** 2, joints)
    animations = "".join(animation(j, 200) for j in range(joints))
    nodes = (bones + "</node>" * joints + '<node id="figure"><instance_controller url="#body">'
             '<skeleton>#bone0</skeleton><bind_material><technique_common><instance_material '
             'symbol="m" target="#grey"/></technique_common></bind_material></instance_controller>'
             '</node>\n')
    count = 0
    while len(meshes) + len(controllers) + len(animations) + len(nodes) < size - 300000:
        meshes += grid_mesh(f"mesh{count}", 60)
        nodes += (f'<node id="node{count}"><translate sid="t">{3 * count} 0 0</translate>'
                  f'<instance_geometry url="#mesh{count}"><bind_material><technique_common>'
                  '<instance_material symbol="m" target="#grey"/></technique_common></bind_material>'
                  '</instance_geometry></node>\n')
        count += 1
    with open(path, "w") as out:
        out.write('<?xml version="1.0" encoding="utf-8"?>\n<COLLADA '
                  'xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">\n<asset>'
                  '<created>2026-01-01T00:00:00Z</created><modified>2026-01-01T00:00:00Z</modified>'
                  '<unit name="meter" meter="1"/><up_axis>Y_UP</up_axis></asset>\n'
                  '<library_effects><effect id="grey-fx"><profile_COMMON><technique sid="common">'
                  '<lambert><diffuse><color>0.5 0.5 0.5 1</color></diffuse></lambert></technique>'
                  '</profile_COMMON></effect></library_effects>\n<library_materials><material '
                  'id="grey"><instance_effect url="#grey-fx"/></material></library_materials>\n'
                  f'<library_geometries>\n{meshes}</library_geometries>\n<library_controllers>\n'
                  f'{controllers}</library_controllers>\n<library_animations>\n{animations}'
                  '</library_animations>\n<library_visual_scenes><visual_scene id="scene">\n'
                  f'{nodes}</visual_scene></library_visual_scenes>\n<scene><instance_visual_scene '
                  'url="#scene"/></scene>\n</COLLADA>\n')


if __name__ == "__main__":
    if len(sys.argv) < 2 or sys.argv[1].startswith("-"):
        sys.exit(__doc__)
    main()
