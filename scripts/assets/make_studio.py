#!/usr/bin/env python3
"""Writes assets/scenes/studio.dae and its picture: a tiled floor seen along it, a lamp with a face, two mirrors that
see each other, glass that blows up, a vane that turns fast, a pane that reflects and lets through, a veil that fades, a
banner on six joints and a stone that looks around. What knobs of light, textures, rays, skins and keys trade shows here.

    python3 make_studio.py ../../assets/scenes/studio.dae
"""
import math
import struct
import sys
import zlib
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from make_rays import effect, geometry, icosphere, place, quad  # noqa: E402

TILES = 64  # pixels a side of the picture
FRAMES = 24
TURNS = 6  # keys of the vane after the first, each a third of a turn on


def png(path):
    """Eight by eight tiles with a line between them."""
    def pixel(x, y):
        if x % 8 == 0 or y % 8 == 0:
            return b"\x28\x28\x30"
        return b"\xe6\xdc\xc8" if (x // 8 + y // 8) % 2 else b"\x8c\x32\x28"

    def chunk(kind, body):
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))
    rows = b"".join(b"\0" + b"".join(pixel(x, y) for x in range(TILES)) for y in range(TILES))
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", TILES, TILES, 8, 2, 0, 0, 0)) +
                     chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b""))


def tiled(name, picture):
    return (f'<effect id="{name}-fx"><profile_COMMON><newparam sid="s"><surface type="2D"><init_from>{name}-image'
            '</init_from></surface></newparam><newparam sid="t"><sampler2D><source>s</source></sampler2D></newparam>'
            '<technique sid="default"><lambert><diffuse><texture texture="t" texcoord="UV"/></diffuse></lambert>'
            '</technique></profile_COMMON></effect>\n',
            f'<material id="{name}"><instance_effect url="#{name}-fx"/></material>\n',
            f'<image id="{name}-image"><init_from>{picture}</init_from></image>\n')


def code_of(name, stages, code):
    passes = "".join(f'<shader stage="{stage}"><name>{shader}</name></shader>' for stage, shader in stages)
    return (f'<effect id="{name}-fx"><profile_RSL><technique sid="default"><code><![CDATA[{code}]]></code>'
            f'<pass>{passes}</pass></technique></profile_RSL></effect>\n',
            f'<material id="{name}"><instance_effect url="#{name}-fx"/></material>\n')


MIRROR = """
surface mirror(color tint = color(0.9, 0.93, 0.95);) {
    normal Nf = faceforward(normalize(N), I);
    Oi = 1;
    Ci = tint * trace(P, reflect(normalize(I), Nf)) + 0.02 * diffuse(Nf);
}
"""
PANEL = """
light panel(float intensity = 9; color lightcolor = color(1, 0.95, 0.86);) {
    illuminate(P, N, 1.5707963) Cl = intensity * lightcolor * max(0, normalize(L) . normalize(N)) / (L . L);
}
surface glow(color lightcolor = color(1, 0.95, 0.86);) { Oi = 1; Ci = lightcolor; }
"""
PAINT = """
surface paint(color tint = color(0.95, 0.75, 0.1);) {
    normal Nf = faceforward(normalize(N), I);
    Oi = 1;
    Ci = tint * (0.15 + diffuse(Nf));
}
"""
PANE = """
surface pane(float Kr = 0.5;) {
    normal Nf = faceforward(normalize(N), I);
    Oi = 0.5;
    Ci = Kr * trace(P, reflect(normalize(I), Nf), "weight", color(Kr), "opacity", Oi);
}
"""
VEIL = """
class veil(color tint = color(0.9, 0.3, 0.35);) {
    public void opacity(output color Oi) { Oi = 0.9 * pow(ycomp(transform("object", P)) / 2, 6); }
    public void surface(output color Ci, Oi) {
        normal Nf = faceforward(normalize(N), I);
        Ci = Oi * tint * (0.3 + diffuse(Nf));
    }
}
"""
BANNER = """
surface banner(color red = color(0.75, 0.1, 0.1); color white = color(0.95, 0.92, 0.85);) {
    normal Nf = faceforward(normalize(N), I);
    point Q = transform("object", P);
    Oi = 1;
    Ci = mix(red, white, step(0.5, mod(8 * xcomp(Q), 1))) * (0.2 + diffuse(Nf));
}
"""
STONE = """
surface stone(color tint = color(0.6, 0.65, 0.55);) {
    normal Nf = faceforward(normalize(N), I);
    color sum = 0, seen = 0;
    float turn;
    for (turn = 0; turn < 3; turn += 1)
        gather("", P, Nf, 1.5707963, 8, "surface:Ci", seen) { sum += seen; } else { sum += color(0.3, 0.4, 0.5); }
    Oi = 1;
    Ci = tint * (diffuse(Nf) + sum / 24);
}
"""
SKY = """
surface sky() { Oi = 1; Ci = mix(color(0.75, 0.8, 0.85), color(0.2, 0.4, 0.7), t); }
"""


def floor():
    """A quad of 60 by 60 units whose picture repeats 15 times, with its texture coordinates."""
    mesh = geometry("floor", quad([(-30, 0, 10), (30, 0, 10), (30, 0, -50), (-30, 0, -50)], (0, 1, 0)))
    uv = ('<source id="floor-u"><float_array id="floor-u-a" count="8">0 0 15 0 15 15 0 15</float_array>'
          '<technique_common><accessor source="#floor-u-a" count="4" stride="2"><param name="S" type="float"/>'
          '<param name="T" type="float"/></accessor></technique_common></source>\n')
    mesh = mesh.replace('<vertices ', uv + '<vertices ', 1)
    return mesh.replace('offset="0"/><p>', 'offset="0"/><input semantic="TEXCOORD" source="#floor-u" offset="0" '
                        'set="0"/><p>', 1)


def morph(name, levels):
    """A ball that becomes one of 2.5 times the size, ever more lengthened: boxes of its tree grow."""
    points, normals, faces = icosphere(levels)
    grown = [(2.5 * x, 2.5 * y * (1 + 0.5 * y), 2.5 * z) for x, y, z in points]
    return (geometry(name, (points, normals, faces)) + geometry(f"{name}-grown", (grown, normals, faces)),
            f'<controller id="{name}-morph"><morph source="#{name}" method="NORMALIZED">'
            f'<source id="{name}-targets"><IDREF_array id="{name}-targets-a" count="1">{name}-grown</IDREF_array>'
            f'<technique_common><accessor source="#{name}-targets-a" count="1"><param name="MORPH_TARGET" type="IDREF"/>'
            '</accessor></technique_common></source>'
            f'<source id="{name}-weights"><float_array id="{name}-weights-a" count="1">0</float_array>'
            f'<technique_common><accessor source="#{name}-weights-a" count="1"><param name="MORPH_WEIGHT" type="float"/>'
            '</accessor></technique_common></source>'
            f'<targets><input semantic="MORPH_TARGET" source="#{name}-targets"/>'
            f'<input semantic="MORPH_WEIGHT" source="#{name}-weights"/></targets></morph></controller>\n')


def keys(name, target, times, values, param, kind="float", stride=1):
    """LINEAR keys of one channel."""
    def source(part, what, texts, of, accessor):
        array = "Name_array" if what == "name" else "float_array"
        return (f'<source id="{name}-{part}"><{array} id="{name}-{part}-a" count="{len(texts)}">{" ".join(texts)}</{array}>'
                f'<technique_common><accessor source="#{name}-{part}-a" count="{len(times)}"{accessor}><param name="{of}" '
                f'type="{what if part != "out" else kind}"/></accessor></technique_common></source>')
    texts = [f"{value:g}" for value in values]
    return (f'<animation id="{name}">' + source("in", "float", [f"{time:.9g}" for time in times], "TIME", "") +
            source("out", "float", texts, param, f' stride="{stride}"' if stride > 1 else "") +
            source("way", "name", ["LINEAR"] * len(times), "INTERPOLATION", "") +
            f'<sampler id="{name}-s"><input semantic="INPUT" source="#{name}-in"/><input semantic="OUTPUT" '
            f'source="#{name}-out"/><input semantic="INTERPOLATION" source="#{name}-way"/></sampler>'
            f'<channel source="#{name}-s" target="{target}"/></animation>')


def turned(turns):
    """About z, where the vane stands; row-major."""
    c, s = math.cos(2 * math.pi * turns), math.sin(2 * math.pi * turns)
    return [round(x, 7) for x in (c, -s, 0, 0, s, c, 0, 1.75, 0, 0, 1, -0.5, 0, 0, 0, 1)]


def animations():
    end = FRAMES / 24
    spin = [x for key in range(TURNS + 1) for x in turned(key / 3)]
    return ('<library_animations>' + keys("grow", "drop-weights(0)", [0, end], [0, 1], "WEIGHT") +
            keys("spin", "vane-node/place", [end * key / TURNS for key in range(TURNS + 1)], spin, "TRANSFORM",
                 "float4x4", 16) +
            keys("lift", "banner-joint0/place.Y", [0, end], [0, 0.7], "Y") +
            keys("sink", f"banner-joint{JOINTS - 1}/place.Y", [0, end / 2, end], [0, 1, 0.2], "Y") +
            '</library_animations>\n')


def vane():
    """Three blades, each a third of a turn on and of another length."""
    points, faces = [], []
    for blade, length in enumerate((0.7, 0.55, 0.4)):
        c, s = math.cos(2 * math.pi * blade / 3), math.sin(2 * math.pi * blade / 3)
        points += [(c * x - s * y, s * x + c * y, 0) for x, y in ((0, -0.07), (length, -0.07), (length, 0.07), (0, 0.07))]
        faces += [(4 * blade + a, 4 * blade + b, 4 * blade + d) for a, b, d in ((0, 1, 2), (0, 2, 3))]
    return points, [(0, 0, 1)] * len(points), faces


JOINTS, COLUMNS, LENGTH = 6, 24, 1.3


def banner():
    """A strip along x from the middle of its left edge, and the x of its joints."""
    xs = [LENGTH * i / COLUMNS for i in range(COLUMNS + 1)]
    points = [(x, y, 0) for y in (-0.2, 0.2) for x in xs]
    above = COLUMNS + 1
    faces = [face for i in range(COLUMNS) for face in ((i, i + 1, above + i + 1), (i, above + i + 1, above + i))]
    return (points, [(0, 0, 1)] * len(points), faces), [LENGTH * j / (JOINTS - 1) for j in range(JOINTS)]


def skin(name, mesh, at):
    """Each vertex hangs from all joints, from near ones most."""
    def array(part, kind, texts, stride, of):
        return (f'<source id="{name}-{part}"><{kind}_array id="{name}-{part}-a" count="{len(texts)}">{" ".join(texts)}'
                f'</{kind}_array><technique_common><accessor source="#{name}-{part}-a" count="{len(texts) // stride}" '
                f'stride="{stride}"><param name="{of}" type="{"float4x4" if stride > 1 else kind.lower()}"/></accessor>'
                '</technique_common></source>')
    weights, pairs = [], []
    for x, _, _ in mesh[0]:
        near = [math.exp(-((x - joint) / (0.8 * LENGTH)) ** 2) for joint in at]
        for joint, weight in enumerate(near):
            pairs.append(f"{joint} {len(weights)}")
            weights.append(f"{weight / sum(near):.6f}")
    back = [f"{x:g}" for joint in at for x in (1, 0, 0, -joint, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1)]
    return (f'<controller id="{name}-skin"><skin source="#{name}">' +
            array("joints", "Name", [f"{name}-joint{j}" for j in range(JOINTS)], 1, "JOINT") +
            array("back", "float", back, 16, "TRANSFORM") + array("weights", "float", weights, 1, "WEIGHT") +
            f'<joints><input semantic="JOINT" source="#{name}-joints"/><input semantic="INV_BIND_MATRIX" '
            f'source="#{name}-back"/></joints><vertex_weights count="{len(mesh[0])}"><input semantic="JOINT" '
            f'source="#{name}-joints" offset="0"/><input semantic="WEIGHT" source="#{name}-weights" offset="1"/>'
            f'<vcount>{" ".join([str(JOINTS)] * len(mesh[0]))}</vcount><v>{" ".join(pairs)}</v></vertex_weights></skin>'
            '</controller>\n')


def place_skin(name, look, transform, at):
    bones = "".join(f'<node id="{name}-joint{j}" sid="{name}-joint{j}" type="JOINT"><translate sid="place">{x:g} 0 0'
                    '</translate></node>' for j, x in enumerate(at))
    return (f'<node id="{name}-bones">{transform}{bones}</node><node><instance_controller url="#{name}-skin"><skeleton>'
            f'#{name}-bones</skeleton><bind_material><technique_common><instance_material symbol="skin" target="#{look}"/>'
            '</technique_common></bind_material></instance_controller></node>\n')


def place_morph(name, look, transform):
    return (f'<node>{transform}<instance_controller url="#{name}-morph"><bind_material><technique_common>'
            f'<instance_material symbol="skin" target="#{look}"/></technique_common></bind_material>'
            '</instance_controller></node>\n')


def main():
    out_path = Path(sys.argv[1])
    png(out_path.parent / "studio_tiles.png")
    tiles = tiled("tiles", "studio_tiles.png")
    effects = [tiles[:2], effect("glass", "glass"), code_of("mirror", [("SURFACE", "mirror")], MIRROR),
               code_of("sky", [("SURFACE", "sky")], SKY), code_of("paint", [("SURFACE", "paint")], PAINT),
               code_of("pane", [("SURFACE", "pane")], PANE), code_of("veil", [("SURFACE", "veil")], VEIL),
               code_of("cloth", [("SURFACE", "banner")], BANNER), code_of("stone", [("SURFACE", "stone")], STONE),
               code_of("panel", [("LIGHT", "panel"), ("SURFACE", "glow")], PANEL)]
    meshes, controller = morph("drop", 3)
    meshes += floor() + geometry("left", quad([(-2.2, 0, 1), (-2.2, 0, -5), (-2.2, 3, -5), (-2.2, 3, 1)], (1, 0, 0)))
    meshes += geometry("right", quad([(2.2, 0, -5), (2.2, 0, 1), (2.2, 3, 1), (2.2, 3, -5)], (-1, 0, 0)))
    meshes += geometry("lamp", quad([(-0.8, 3.4, 0), (-0.8, 3.4, -2), (0.8, 3.4, -2), (0.8, 3.4, 0)], (0, -1, 0)))
    meshes += geometry("ball", icosphere(3)) + geometry("vane", vane())
    meshes += geometry("backdrop", quad([(-60, -1, -49), (60, -1, -49), (60, 40, -49), (-60, 40, -49)], (0, 0, 1)))
    meshes += geometry("glazing", quad([(-1.3, 0, -3.4), (1.3, 0, -3.4), (1.3, 1.7, -3.4), (-1.3, 1.7, -3.4)], (0, 0, 1)))
    meshes += geometry("curtain", quad([(-2, 0.1, -1.6), (-1.1, 0.1, -1.2), (-1.1, 2, -1.2), (-2, 2, -1.6)], (0.4, 0, 0.9)))
    strip, at = banner()
    meshes += geometry("banner", strip)
    controller += skin("banner", strip, at)
    nodes = (place("floor", "tiles").replace("</instance_material>", "").replace(
        'target="#tiles"/>', 'target="#tiles"><bind_vertex_input semantic="UV" input_semantic="TEXCOORD" '
        'input_set="0"/></instance_material>') + place("left", "mirror") + place("right", "mirror") +
        place("lamp", "panel") + place("backdrop", "sky") + place_morph("drop", "glass", "<translate>0.9 0.75 -0.6</translate>"
                                             "<scale>0.3 0.3 0.3</scale>") +
        place("vane", "paint", f'<matrix sid="place">{" ".join(f"{x:g}" for x in turned(0))}</matrix>').replace(
            "<node>", '<node id="vane-node">') +
        place("ball", "glass", "<translate>-0.9 0.5 -0.2</translate><scale>0.5 0.5 0.5</scale>") +
        place("ball", "mirror", "<translate>0 0.6 -2.4</translate><scale>0.6 0.6 0.6</scale>") +
        place("ball", "stone", "<translate>0.15 0.17 0.9</translate><scale>0.17 0.17 0.17</scale>") +
        place("glazing", "pane") + place("curtain", "veil") +
        place_skin("banner", "cloth", "<translate>0.5 1.9 -1.5</translate>", at))
    out_path.write_text(
        '<?xml version="1.0" encoding="utf-8"?>\n<!-- Made by scripts/assets/make_studio.py. -->\n'
        '<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">\n<asset>'
        '<created>2026-11-24T00:00:00Z</created><modified>2026-11-24T00:00:00Z</modified>'
        '<unit name="meter" meter="1"/><up_axis>Y_UP</up_axis></asset>\n' + animations() +
        '<library_cameras><camera id="eye"><optics><technique_common><perspective><yfov>40</yfov>'
        '<aspect_ratio>1.3333</aspect_ratio><znear>0.1</znear><zfar>200</zfar></perspective></technique_common></optics>'
        '</camera></library_cameras>\n'
        '<library_images>\n' + tiles[2] + '</library_images>\n'
        '<library_effects>\n' + "".join(e for e, _ in effects) + '</library_effects>\n'
        '<library_materials>\n' + "".join(m for _, m in effects) + '</library_materials>\n'
        '<library_geometries>\n' + meshes + '</library_geometries>\n'
        '<library_controllers>\n' + controller + '</library_controllers>\n'
        '<library_visual_scenes><visual_scene id="scene">\n'
        '<node id="eye-node"><translate>0 1.3 4.5</translate><rotate>1 0 0 -4</rotate><instance_camera url="#eye"/>'
        '</node>\n' + nodes + '</visual_scene></library_visual_scenes>\n'
        '<scene><instance_visual_scene url="#scene"/></scene>\n</COLLADA>\n')


if __name__ == "__main__":
    main()
