"""tests/programs/scaled_scenes.py: a COLLADA scene below a node that scales or moves it, which its picture may not
show, and a small scene of each kind of content."""
import math
import sys
import xml.etree.ElementTree as ET

from programs import SOURCE
from written_scenes import (CAMERA, EYE, animation, animations, camera, common, controllers, document, geometries, mesh,
                            morph, one_joint_skin, place, rsl, source, square)

sys.path.insert(0, str(SOURCE / "scripts/sheet"))
import png  # noqa: E402

# What docs/format.md gives in the file's unit and not in the node's: factors of the scale.
OF_THE_FILE = {"linear_attenuation": -1, "quadratic_attenuation": -2, "xmag": 1, "ymag": 1}


def local(element):
    return element.tag.rpartition("}")[2]


def scaled(text, scale=1.0, move=(0, 0, 0)):
    """The document with all nodes of its visual scenes below one node."""
    root = ET.fromstring(text)
    space = root.tag.rpartition("}")[0] + "}" if "}" in root.tag else ""
    if space:
        ET.register_namespace("", space[1:-1])
    for element in list(root.iter()):
        power = OF_THE_FILE.get(local(element))
        if power and (element.text or "").strip():
            element.text = repr(float(element.text) * float(scale) ** power)
        if local(element) != "visual_scene":
            continue
        nodes = [child for child in element if local(child) == "node"]
        if not nodes:
            continue
        above = ET.Element(space + "node", {"id": "kinora-scaled"})
        for name, numbers in (("translate", move), ("scale", (scale,) * 3)):
            ET.SubElement(above, space + name).text = " ".join(map(repr, map(float, numbers)))
        element.insert(list(element).index(nodes[0]), above)
        for node in nodes:
            element.remove(node)
            above.append(node)
    return ET.tostring(root, encoding="unicode")


def difference(a, b):
    """Of two PNG files: the mean over all numbers, of 1."""
    rows_a, rows_b = png.read(a)[2], png.read(b)[2]
    numbers = sum(len(row) for row in rows_a)
    return sum(abs(x - y) for p, q in zip(rows_a, rows_b, strict=True) for x, y in zip(p, q)) / numbers / 255


# ---- a scene of each kind

EYE_AT = "<lookat>2 -3 1.5 0 0 0 0 0 1</lookat>"
PERSPECTIVE = ("<library_cameras><camera id=\"cam\"><optics><technique_common><perspective><yfov>40</yfov>"
               "<znear>{}</znear><zfar>{}</zfar></perspective></technique_common></optics></camera></library_cameras>")
VIEW = PERSPECTIVE.format(0.1, 100)
LOOK = f'<node id="eye">{EYE_AT}<instance_camera url="#cam"/></node>'
MATTE = common("lambert", "diffuse")


def light(kind, inside="", at="<lookat>1 -3 3 0 0 0 0 0 1</lookat>"):
    """A library, and the node that has the light."""
    return (f'<library_lights><light id="lamp"><technique_common><{kind}><color>1 0.9 0.8</color>{inside}</{kind}>'
            '</technique_common></light></library_lights>',
            f'<node>{at}<instance_light url="#lamp"/></node>')


SUN, SUN_NODE = light("directional")


def ball(id="ball", rings=8, unit=1.0):
    """A sphere of few faces, with normals and texture coordinates."""
    points, uv, faces, around = [], [], [], 2 * rings
    for i in range(rings + 1):
        for j in range(around + 1):
            high, turn = math.pi * i / rings, 2 * math.pi * j / around
            points.append((math.sin(high) * math.cos(turn), math.sin(high) * math.sin(turn), math.cos(high)))
            uv += [j / around, i / rings]
    for i in range(rings):
        for j in range(around):
            a, b = i * (around + 1) + j, (i + 1) * (around + 1) + j
            faces += [a, b, b + 1, a, b + 1, a + 1]
    flat = [c for p in points for c in p]
    text = (source(f"{id}-p", [unit * c for c in flat], 3) + source(f"{id}-n", flat, 3) + source(f"{id}-t", uv, 2, "ST"))
    return (f'<geometry id="{id}"><mesh>{text}<vertices id="{id}-v"><input semantic="POSITION" source="#{id}-p"/></vertices>'
            f'<triangles count="{len(faces) // 3}" material="m"><input semantic="VERTEX" source="#{id}-v" offset="0"/>'
            f'<input semantic="NORMAL" source="#{id}-n" offset="0"/><input semantic="TEXCOORD" source="#{id}-t" offset="0" '
            f'set="0"/><p>{" ".join(map(str, faces))}</p></triangles></mesh></geometry>')


FLOOR = square("floor", 3)
ON_FLOOR = place("<translate>0 0 -1</translate>", "#floor", id="floor-node")
BALL = place(url="#ball", id="ball-node")
TURNING = animations(animation("turn", "ball-node/r.ANGLE", [0, 1], [0, 360]))


def of_look(look, nodes=BALL, meshes=(ball(),), more=""):
    return document(VIEW + SUN + look + geometries(*meshes) + more, LOOK + SUN_NODE + nodes)


def lit_by(kind, inside, at):
    lamp, node = light(kind, inside, at)
    return document(VIEW + lamp + MATTE + geometries(ball(), FLOOR), LOOK + node + BALL + ON_FLOOR)


def of_code(code, **more):
    return of_look(rsl(code), **more)


WAVES = 'float h = 0.04 * sin(40 * s) * sin(30 * t);'
SHADED = "surface s() { Oi = 1; Ci = ambient() + diffuse(faceforward(normalize(N), I)); }"


def of_passes(code, *stages, **more):
    """A look of several shaders, one a stage."""
    return of_look(rsl(code).replace('<shader stage="SURFACE"></shader>',
                                     "".join(f'<shader stage="{stage}"/>' for stage in stages)), **more)


DISPLACED = ("displacement d() { " + WAVES + ' P += h * vtransform("object", "current", normalize(ntransform("object", N)));'
             " N = calculatenormal(P); } " + SHADED)
# What depends on a length has it in the object's units: in the world's the picture would rightly change.
GLOWING = ('light glow() { illuminate(P, N, PI / 2) { vector l = vtransform("shader", L);'
           " Cl = 4 * max(0, normalize(L) . normalize(N)) / (l . l); } } " + SHADED)
SYRUP = ('volume syrup() { float thick = 1 - exp(-0.8 * length(vtransform("shader", I)));'
         " Ci = mix(Ci, color(0.6, 0.2, 0.1), thick); Oi = mix(Oi, color(1, 1, 1), thick); }"
         " surface s() { Oi = 0.2; Ci = Oi * diffuse(normalize(N)); }")
ALL = {"nodes": BALL + ON_FLOOR, "meshes": (ball(), FLOOR)}


# Kind of content -> document. Each has its own size of about 2 units.
KINDS = {
    "normals": of_look(MATTE),
    "facets": document(VIEW + SUN + MATTE + geometries(square()), LOOK + SUN_NODE + place("<rotate>1 0 0 20</rotate>")),
    "texture": of_code("surface s() { Oi = 1; float a = mod(floor(8 * s) + floor(8 * t), 2);"
                       " Ci = mix(color(0.9, 0.8, 0.2), color(0.1, 0.2, 0.7), filterstep(0.5, a)) * diffuse(normalize(N)); }"),
    "noise": of_code('surface s() { Oi = 1; Ci = noise(6 * transform("object", P)) * diffuse(normalize(N)); }'),
    "bump": of_code("surface s() { " + WAVES + " point p = P + h * vtransform(\"object\", \"current\", normalize("
                    "ntransform(\"object\", N))); normal n = faceforward(normalize(calculatenormal(p)), I);"
                    " Oi = 1; Ci = ambient() + diffuse(n); }"),
    "displacement": of_passes(DISPLACED, "DISPLACEMENT", "SURFACE"),
    "moving instance": of_look(MATTE, place('<rotate sid="r">0 0 1 0</rotate>', "#ball", id="ball-node"), more=TURNING),
    "small part": of_look(MATTE, place('<scale>1e4 1e4 1e4</scale><rotate sid="r">0 0 1 0</rotate>', "#ball", id="ball-node"),
                          (ball(unit=1e-4),), TURNING),
    "large part": of_look(MATTE, place('<scale>1e-7 1e-7 1e-7</scale><rotate sid="r">0 0 1 0</rotate>', "#ball",
                                       id="ball-node"), (ball(unit=1e7),), TURNING),
    "skin": of_look(MATTE, '<node id="joint-node" sid="j" type="JOINT"><scale sid="s">1 1 1</scale></node>' +
                    place(url="#skin", kind="controller", id="ball-node", skeleton="<skeleton>#joint-node</skeleton>"),
                    more=controllers(one_joint_skin("ball", "1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1", 153)) +
                    animations(animation("grow", "joint-node/s.Z", [0, 1], [1, 1.5]))),
    "morph": of_look(MATTE, place(url="#morph", kind="controller", id="ball-node"), (ball(), ball("target", unit=1.5)),
                     controllers(morph("ball", "target", 0.5)) + animations(
                         animation("m", "morph-w(0)", [0, 1], [0, 1]))),
    "shadow": lit_by("directional", "", "<lookat>-1 -1 2 0 0 0 0 0 1</lookat>"),
    "point light": lit_by("point", "", "<translate>1 -2 3</translate>"),
    "attenuation": lit_by("point", "<constant_attenuation>0.2</constant_attenuation><linear_attenuation>0.1"
                          "</linear_attenuation><quadratic_attenuation>0.05</quadratic_attenuation>",
                          "<translate>1 -2 3</translate>"),
    "spot": lit_by("spot", "<falloff_angle>40</falloff_angle><falloff_exponent>2</falloff_exponent>",
                   "<lookat>1 -2 3 0 0 0 0 0 1</lookat>"),
    "clips": document(PERSPECTIVE.format(3.2, 4.2) + SUN + MATTE + geometries(ball()), LOOK + SUN_NODE + BALL),
    "orthographic": document(CAMERA + SUN + MATTE + geometries(ball()), EYE + SUN_NODE + BALL),
    "default camera": document(SUN + MATTE + geometries(ball(), FLOOR), SUN_NODE + BALL + ON_FLOOR),
    "default lights": document(VIEW + MATTE + geometries(ball(), FLOOR), LOOK + BALL + ON_FLOOR),
    "mirror": of_code("surface s() { Oi = 1; vector R = reflect(normalize(I), normalize(N));"
                      " Ci = 0.2 * diffuse(normalize(N)) + 0.8 * trace(P, R); }",
                      **ALL),
    "occlusion": of_code("surface s() { Oi = 1; normal n = faceforward(normalize(N), I);"
                         ' Ci = 1 - occlusion(P, n, 16); }', **ALL),
    "bounced light": of_code("surface s() { Oi = 1; normal n = faceforward(normalize(N), I);"
                             " Ci = diffuse(n) + 0.5 * indirectdiffuse(P, n, 16); }", **ALL),
    "glass": of_code("surface s() { Oi = 0.3; Ci = Oi * diffuse(normalize(N)); }", **ALL),
    "volume": of_passes(SYRUP, "SURFACE", "VOLUME", **ALL),
    "area light": of_passes(GLOWING, "LIGHT", "SURFACE", **ALL),
    "large mesh": of_look(MATTE, place("<scale>1e-12 1e-12 1e-12</scale>", "#ball", id="ball-node"), (ball(unit=1e12),)),
    "small mesh": of_look(MATTE, place("<scale>1e12 1e12 1e12</scale>", "#ball", id="ball-node"), (ball(unit=1e-12),)),
}
