#!/usr/bin/env python3
"""Writes assets/scenes/rays.dae: a room whose shaders trace: glass and lacquer balls between walls
that bleed. Needs no Blender: python3 make_rays.py > ../../assets/scenes/rays.dae"""
import math
import os
import sys


def icosphere(levels):
    t = (1 + math.sqrt(5)) / 2
    points = [(-1, t, 0), (1, t, 0), (-1, -t, 0), (1, -t, 0), (0, -1, t), (0, 1, t),
              (0, -1, -t), (0, 1, -t), (t, 0, -1), (t, 0, 1), (-t, 0, -1), (-t, 0, 1)]
    unit = lambda p: tuple(c / math.sqrt(sum(x * x for x in p)) for c in p)
    points = [unit(p) for p in points]
    faces = [(0, 11, 5), (0, 5, 1), (0, 1, 7), (0, 7, 10), (0, 10, 11), (1, 5, 9), (5, 11, 4),
             (11, 10, 2), (10, 7, 6), (7, 1, 8), (3, 9, 4), (3, 4, 2), (3, 2, 6), (3, 6, 8),
             (3, 8, 9), (4, 9, 5), (2, 4, 11), (6, 2, 10), (8, 6, 7), (9, 8, 1)]
    for _ in range(levels):
        middle, out = {}, []

        def split(a, b):
            key = (min(a, b), max(a, b))
            if key not in middle:
                middle[key] = len(points)
                points.append(unit(tuple(x + y for x, y in zip(points[a], points[b]))))
            return middle[key]

        for a, b, c in faces:
            ab, bc, ca = split(a, b), split(b, c), split(c, a)
            out += [(a, ab, ca), (b, bc, ab), (c, ca, bc), (ab, bc, ca)]
        faces = out
    return points, points, faces


def quad(corners, normal):
    return corners, [normal] * 4, [(0, 1, 2), (0, 2, 3)]


def geometry(name, mesh):
    points, normals, faces = mesh

    def source(part, values):
        text = " ".join(f"{c:.6g}" for p in values for c in p)
        return (f'<source id="{name}-{part}"><float_array id="{name}-{part}-a" '
                f'count="{3 * len(values)}">{text}</float_array><technique_common><accessor '
                f'source="#{name}-{part}-a" count="{len(values)}" stride="3">'
                '<param name="X" type="float"/><param name="Y" type="float"/>'
                '<param name="Z" type="float"/></accessor></technique_common></source>\n')

    p = " ".join(f"{k}" for f in faces for k in f)
    return (f'<geometry id="{name}"><mesh>{source("p", points)}{source("n", normals)}'
            f'<vertices id="{name}-v"><input semantic="POSITION" source="#{name}-p"/>'
            f'<input semantic="NORMAL" source="#{name}-n"/></vertices><triangles material="skin" '
            f'count="{len(faces)}"><input semantic="VERTEX" source="#{name}-v" offset="0"/>'
            f'<p>{p}</p></triangles></mesh></geometry>\n')


def effect(name, shader, binds=""):
    folder = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../assets/shaders/surface")
    with open(os.path.join(folder, shader + ".sl")) as file:
        code = file.read()
    return (f'<effect id="{name}-fx"><profile_RSL><technique sid="default"><code><![CDATA[\n{code}'
            f']]></code><pass><shader stage="SURFACE"><name>{shader}</name>{binds}</shader></pass>'
            '</technique></profile_RSL></effect>\n',
            f'<material id="{name}"><instance_effect url="#{name}-fx"/></material>\n')


def place(mesh, look, transform=""):
    return (f'<node>{transform}<instance_geometry url="#{mesh}"><bind_material><technique_common>'
            f'<instance_material symbol="skin" target="#{look}"/></technique_common>'
            '</bind_material></instance_geometry></node>\n')


def painted(name, rgb):
    code = (f'surface {name}(float Kd = 0.75; float samples = 24;) {{ normal Nf = '
            'faceforward(normalize(N), I); Oi = 1; color paint = color '
            f'({rgb}); float depth = 0; rayinfo("depth", depth); float n = depth > 0 ? 4 : samples;'
            ' Ci = paint * Kd * (diffuse(Nf) + indirectdiffuse(P, Nf, n)); }')
    return (f'<effect id="{name}-fx"><profile_RSL><technique sid="default"><code>'
            f'<![CDATA[{code}]]></code><pass><shader stage="SURFACE"><name>{name}</name></shader></pass>'
            '</technique>'
            f'</profile_RSL></effect>\n',
            f'<material id="{name}"><instance_effect url="#{name}-fx"/></material>\n')


def main():
    effects = [effect("glass", "glass"), effect("lacquer", "glossy"),
               effect("clay", "occlusion", '<bind symbol="samples"><float>32</float></bind>'
                      '<bind symbol="maxdist"><float>1</float></bind>'),
               painted("white", "0.9, 0.88, 0.85"), painted("red", "0.85, 0.12, 0.1"),
               painted("green", "0.15, 0.65, 0.2")]
    s = 2
    walls = {
        "floor": quad([(-s, 0, s), (s, 0, s), (s, 0, -s), (-s, 0, -s)], (0, 1, 0)),
        "ceiling": quad([(-s, 3, s), (-s, 3, -s), (s, 3, -s), (s, 3, s)], (0, -1, 0)),
        "back": quad([(-s, 0, -s), (s, 0, -s), (s, 3, -s), (-s, 3, -s)], (0, 0, 1)),
        "left": quad([(-s, 0, s), (-s, 0, -s), (-s, 3, -s), (-s, 3, s)], (1, 0, 0)),
        "right": quad([(s, 0, -s), (s, 0, s), (s, 3, s), (s, 3, -s)], (-1, 0, 0)),
    }
    out = sys.stdout.write
    out('<?xml version="1.0" encoding="utf-8"?>\n<!-- Made by scripts/assets/make_rays.py. -->\n'
        '<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">\n<asset>'
        '<created>2026-11-21T00:00:00Z</created><modified>2026-11-21T00:00:00Z</modified>'
        '<unit name="meter" meter="1"/><up_axis>Y_UP</up_axis></asset>\n')
    out('<library_cameras><camera id="eye"><optics><technique_common><perspective><yfov>38</yfov>'
        '<aspect_ratio>1.3333</aspect_ratio><znear>0.1</znear><zfar>100</zfar></perspective>'
        '</technique_common></optics></camera></library_cameras>\n')
    out('<library_lights><light id="lamp"><technique_common><point><color>1.5 1.42 1.3</color>'
        '<constant_attenuation>1</constant_attenuation>'
        '<quadratic_attenuation>0.15</quadratic_attenuation></point></technique_common></light>'
        '</library_lights>\n')
    out('<library_effects>\n' + "".join(e for e, _ in effects) + '</library_effects>\n')
    out('<library_materials>\n' + "".join(m for _, m in effects) + '</library_materials>\n')
    out('<library_geometries>\n' + "".join(geometry(n, m) for n, m in walls.items()) +
        geometry("ball", icosphere(4)) + '</library_geometries>\n')
    out('<library_visual_scenes><visual_scene id="scene">\n'
        '<node id="eye-node"><translate>0 1.5 6.6</translate><instance_camera url="#eye"/></node>\n'
        '<node id="lamp-node"><translate>0.3 2.3 1.2</translate><instance_light url="#lamp"/></node>\n')
    looks = {"floor": "white", "ceiling": "white", "back": "white", "left": "red", "right": "green"}
    for name, look in looks.items():
        out(place(name, look))
    out(place("ball", "glass", "<translate>0.85 0.6 0.7</translate><scale>0.6 0.6 0.6</scale>"))
    out(place("ball", "lacquer", "<translate>-0.85 0.75 -0.6</translate><scale>.75 .75 .75</scale>"))
    out(place("ball", "clay", "<translate>0 0.3 1.1</translate><scale>0.3 0.3 0.3</scale>"))
    out('</visual_scene></library_visual_scenes>\n'
        '<scene><instance_visual_scene url="#scene"/></scene>\n</COLLADA>\n')


if __name__ == "__main__":
    main()
