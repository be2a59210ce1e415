"""tests/conformance/dae.py: COLLADA documents of one small object, part by part, for the pairs."""
import math
import struct
import zlib

SPACES = {"1.4.1": "http://www.collada.org/2005/11/COLLADASchema",
          "1.5.0": "http://www.collada.org/2008/03/COLLADASchema"}


def numbers(values):
    return " ".join(f"{v:.9g}" for v in values)


def flat(rows):
    return [v for row in rows for v in row]


def source(id, rows, params, array="float_array", kind="float"):
    """Rows of numbers, or words for a Name_array."""
    values = rows if array != "float_array" else flat(rows)
    text = " ".join(values) if array != "float_array" else numbers(values)
    param = "".join(f'<param name="{p}" type="{kind}"/>' for p in params)
    return (f'<source id="{id}"><{array} id="{id}-array" count="{len(values)}">{text}</{array}>'
            f'<technique_common><accessor source="#{id}-array" count="{len(rows)}" '
            f'stride="{len(values) // len(rows)}">{param}</accessor></technique_common></source>\n')


def matrices(id, rows):
    text = source(id, rows, ["TRANSFORM"], kind="float4x4")
    return text


# A house: a pentagon in x and y, from z = -0.3 to 0.3; every face has its own normal.
OUTLINE = [(-.6, -.5), (.6, -.5), (.6, .3), (0, .8), (-.6, .3)]
POINTS = [(x, y, z) for z in (.3, -.3) for x, y in OUTLINE]
FACES = [[0, 1, 2, 3, 4], [9, 8, 7, 6, 5]] + [[k + 5, (k + 1) % 5 + 5, (k + 1) % 5, k] for k in range(5)]


def normal_of(face):
    a, b, c = (POINTS[i] for i in face[:3])
    u, v = [[q[k] - a[k] for k in range(3)] for q in (b, c)]
    n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
    length = sum(x * x for x in n) ** .5
    return tuple(x / length for x in n)


NORMALS = [normal_of(f) for f in FACES]
UVS = [(x / 1.2 + .5, y / 1.3 + .385) for x, y, _ in POINTS]


def corners():
    """(point, normal, uv) of each face's corners, in order."""
    return [[(i, n, i) for i in face] for n, face in enumerate(FACES)]


def triangulated(faces=None):
    return [[f[0], f[k], f[k + 1]] for f in faces or corners() for k in range(1, len(f) - 1)]


INPUTS = ('<input semantic="VERTEX" source="#{0}-v" offset="0"/><input semantic="NORMAL" '
          'source="#{0}-n" offset="1"/><input semantic="TEXCOORD" source="#{0}-t" offset="2" set="0"/>')


def indices(loop):
    return numbers(flat(loop))


def triangles(id="house"):
    rows = triangulated()
    return (f'<triangles count="{len(rows)}" material="m">{INPUTS.format(id)}<p>'
            f'{" ".join(indices(t) for t in rows)}</p></triangles>')


def sources(id="house", points=POINTS):
    return (source(f"{id}-p", points, "XYZ") + source(f"{id}-n", NORMALS, "XYZ")
            + source(f"{id}-t", UVS, "ST")
            + f'<vertices id="{id}-v"><input semantic="POSITION" source="#{id}-p"/></vertices>\n')


def geometry(primitives=None, id="house", points=POINTS, extra=""):
    return (f'<geometry id="{id}"><mesh>{sources(id, points)}{primitives or triangles(id)}\n</mesh>'
            f'{extra}</geometry>\n')


def prism(sides, smooth=None):
    """An upright prism. `smooth`: with normals, along the sides' corners or of the flat faces."""
    turn = [2 * math.pi * k / sides for k in range(sides)]
    rings = [(.6 * math.cos(t), y, .6 * math.sin(t)) for y in (-.5, .5) for t in turn]
    at = [(math.cos(t), 0, math.sin(t)) for t in turn]
    middle = [(math.cos(t + math.pi / sides), 0, math.sin(t + math.pi / sides)) for t in turn]
    ends, first = ([(0, -1, 0), (0, 1, 0)], 2)
    faces = [[(k, 0) for k in range(sides)], [(sides + k, 1) for k in reversed(range(sides))]]
    for k in range(sides):
        n = (k + 1) % sides
        here, there = (first + k, first + n) if smooth else (first + k, first + k)
        faces.append([(k, here), (sides + k, here), (sides + n, there), (n, there)])
    vectors = source("prism-n", ends + (at if smooth else middle), "XYZ") if smooth is not None else ""
    normal = '<input semantic="NORMAL" source="#prism-n" offset="1"/>' if vectors else ""
    p = " ".join(f"{v} {n}" if vectors else f"{v}" for face in faces for v, n in face)
    return (f'<geometry id="house"><mesh>{source("prism-p", rings, "XYZ")}{vectors}<vertices id="prism-v"><input '
            f'semantic="POSITION" source="#prism-p"/></vertices><polylist count="{len(faces)}" material="m"><input '
            f'semantic="VERTEX" source="#prism-v" offset="0"/>{normal}<vcount>{" ".join(str(len(f)) for f in faces)}'
            f'</vcount><p>{p}</p></polylist></mesh></geometry>')


LAMBERT = '<lambert><diffuse><color>.8 .5 .2 1</color></diffuse></lambert>'


def effect(shading=LAMBERT, id="fx", params="", extra=""):
    return (f'<effect id="{id}">{params if params.startswith("<newparam") else ""}<profile_COMMON>'
            f'{"" if params.startswith("<newparam") else params}<technique sid="common">{shading}'
            f'{extra}</technique></profile_COMMON></effect>\n')


def material(id="mat", fx="fx", setparams=""):
    return f'<material id="{id}"><instance_effect url="#{fx}">{setparams}</instance_effect></material>\n'


def bind(inside="", target="mat", symbol="m"):
    return (f'<bind_material><technique_common><instance_material symbol="{symbol}" '
            f'target="#{target}">{inside}</instance_material></technique_common></bind_material>')


def shown(url="#house", inside=None, kind="geometry", skeleton=""):
    return f'<instance_{kind} url="{url}">{skeleton}{inside or bind()}</instance_{kind}>'


PERSPECTIVE = '<perspective><yfov sid="f">40</yfov><znear>.1</znear><zfar>100</zfar></perspective>'
EYE = '<lookat>1.3 .9 3  0 .1 0  0 1 0</lookat>'


def camera(optics=PERSPECTIVE, id="eye"):
    return f'<camera id="{id}"><optics><technique_common>{optics}</technique_common></optics></camera>\n'


SUN = ('<light id="sun"><technique_common><directional><color>1 1 1</color></directional>'
       '</technique_common></light>\n<light id="air"><technique_common><ambient><color>.2 .2 .2'
       '</color></ambient></technique_common></light>\n')
SUN_NODES = ('<node id="sun-node"><rotate>0 1 0 30</rotate><rotate>1 0 0 -40</rotate>'
             '<instance_light url="#sun"/></node>\n<node id="air-node"><instance_light url="#air"/>'
             '</node>\n')
EYE_NODE = f'<node id="eye-node">{EYE}<instance_camera url="#eye"/></node>\n'


def library(kind, content):
    return f"<library_{kind}>\n{content}</library_{kind}>\n" if content.strip() else ""


def document(nodes, geometries=None, *, images="", effects=None, materials=None, lights=SUN,
             light_nodes=SUN_NODES, cameras=None, eye=EYE_NODE, controllers="", animations="",
             clips="", library_nodes="", evaluate="", version="1.4.1", unit='name="meter" meter="1"',
             up="Y_UP", scene=True):
    # In the order that the specification asks for.
    body = (library("animations", animations) + library("animation_clips", clips)
            + library("cameras", camera() if cameras is None else cameras)
            + library("controllers", controllers) + library("images", images)
            + library("effects", effect() if effects is None else effects)
            + library("geometries", geometry() if geometries is None else geometries)
            + library("lights", lights)
            + library("materials", material() if materials is None else materials)
            + library("nodes", library_nodes))
    if scene:
        body += library("visual_scenes", f'<visual_scene id="scene">\n{eye}{light_nodes}{nodes}\n'
                                         f'{evaluate}</visual_scene>\n')
        body += '<scene><instance_visual_scene url="#scene"/></scene>\n'
    return (f'<?xml version="1.0" encoding="utf-8"?>\n<COLLADA xmlns="{SPACES[version]}" '
            f'version="{version}">\n<asset><created>2026-11-21T00:00:00Z</created><modified>'
            f'2026-11-21T00:00:00Z</modified><unit {unit}/><up_axis>{up}</up_axis></asset>\n{body}'
            '</COLLADA>\n')


def node(content=None, transforms="", id="n"):
    return f'<node id="{id}">{transforms}{content or shown()}</node>'


def plain(**parts):
    return document(node(), **parts)


# --- textures

def texture_effect(texture='<texture texture="map-sampler" texcoord="UV"/>', state="", slot="diffuse",
                   version="1.4.1", id="fx", extra=""):
    if version == "1.4.1":
        params = ('<newparam sid="map-surface"><surface type="2D"><init_from>map</init_from></surface>'
                  '</newparam><newparam sid="map-sampler"><sampler2D><source>map-surface</source>'
                  f'{state}</sampler2D></newparam>')
    else:
        params = (f'<newparam sid="map-sampler"><sampler2D><instance_image url="#map"/>{state}'
                  '</sampler2D></newparam>')
    shading = f"<lambert><{slot}>{texture}</{slot}></lambert>"
    return (f'<effect id="{id}"><profile_COMMON>{params}<technique sid="common">{shading}{extra}'
            '</technique></profile_COMMON></effect>\n')


def image(path="map.png", version="1.4.1"):
    inside = path if version == "1.4.1" else f"<ref>{path}</ref>"
    return f'<image id="map"><init_from>{inside}</init_from></image>\n'


UV = '<bind_vertex_input semantic="UV" input_semantic="TEXCOORD" input_set="0"/>'


def textured(*, state="", version="1.4.1", inside=UV, path="map.png", texture=None, extra="", **parts):
    words = {} if texture is None else {"texture": texture}
    return document(node(shown(inside=bind(inside))), images=image(path, version),
                    effects=texture_effect(state=state, version=version, extra=extra, **words),
                    version=version, **parts)


def picture(size=8):
    """Rows of RGB from the top: four quarters of saturated colours with a black frame."""
    def pixel(x, y):
        if x in (0, size - 1) or y == 0:
            return (0, 0, 0)
        return [(255, 0, 0), (0, 255, 0), (0, 0, 255), (255, 255, 0)][(x * 2 // size) + 2 * (y * 2 // size)]
    return [[pixel(x, y) for x in range(size)] for y in range(size)]


def png(rows, channels=3):
    height, width = len(rows), len(rows[0])

    def chunk(kind, data):
        body = kind + data
        return struct.pack(">I", len(data)) + body + struct.pack(">I", zlib.crc32(body))
    kind = {1: 0, 3: 2, 4: 6}[channels]
    raw = b"".join(b"\0" + bytes(flat(row) if channels > 1 else row) for row in rows)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, kind, 0, 0, 0))
            + chunk(b"IDAT", zlib.compress(raw, 9)) + chunk(b"IEND", b""))


def bgr(rows):
    return [bytes(v for r, g, b in row for v in (b, g, r)) for row in rows]


def tga(rows):
    head = struct.pack("<BBBHHBHHHHBB", 0, 0, 2, 0, 0, 0, 0, 0, len(rows[0]), len(rows), 24, 0)
    return head + b"".join(reversed(bgr(rows)))


def bmp(rows):
    width, height = len(rows[0]), len(rows)
    data = b"".join(row + bytes(-len(row) % 4) for row in reversed(bgr(rows)))
    return (struct.pack("<2sIHHI", b"BM", 54 + len(data), 0, 0, 54)
            + struct.pack("<IiiHHIIiiII", 40, width, height, 1, 24, 0, len(data), 2835, 2835, 0, 0) + data)


def tiff(rows):
    width, height = len(rows[0]), len(rows)
    data = b"".join(bytes(flat(row)) for row in rows)
    tags = [(256, 3, 1, width), (257, 3, 1, height), (258, 3, 3, 0), (259, 3, 1, 1), (262, 3, 1, 2),
            (273, 4, 1, 0), (277, 3, 1, 3), (278, 3, 1, height), (279, 4, 1, len(data))]
    bits = 8 + 2 + 12 * len(tags) + 4
    start = bits + 6
    tags = [(t, k, n, {258: bits, 273: start}.get(t, v)) for t, k, n, v in tags]
    return (b"II*\0" + struct.pack("<IH", 8, len(tags)) + b"".join(struct.pack("<HHII", *t) for t in tags)
            + struct.pack("<I", 0) + struct.pack("<HHH", 8, 8, 8) + data)


def dds(rows):
    width, height = len(rows[0]), len(rows)
    head = struct.pack("<4sIIIIIII44x", b"DDS ", 124, 0x100f, height, width, width * 4, 0, 0)
    pixels = struct.pack("<II4sIIIII", 32, 0x41, b"\0\0\0\0", 32, 0xff0000, 0xff00, 0xff, 0xff000000)
    data = b"".join(bytes((b, g, r, 255)) for row in rows for r, g, b in row)
    return head + pixels + struct.pack("<IIIII", 0x1000, 0, 0, 0, 0) + data


# --- animation

def animated(target, times, values, *, interpolation="LINEAR", tangents=None, behaviour="", id="a",
             params="X", components=1):
    """One channel. tangents: (in, out) rows; behaviour: attributes of the sampler."""
    text = source(f"{id}-i", [(t,) for t in times], ["TIME"])
    text += source(f"{id}-o", values, params)
    words = interpolation if isinstance(interpolation, list) else [interpolation] * len(times)
    text += source(f"{id}-k", words, ["INTERPOLATION"], "Name_array", "Name")
    inputs = "".join(f'<input semantic="{s}" source="#{id}-{x}"/>'
                     for s, x in (("INPUT", "i"), ("OUTPUT", "o"), ("INTERPOLATION", "k")))
    for name, letter, rows in zip(("IN_TANGENT", "OUT_TANGENT"), "xy", tangents or ()):
        text += source(f"{id}-{letter}", rows, ["X", "Y"][:len(rows[0])])
        inputs += f'<input semantic="{name}" source="#{id}-{letter}"/>'
    return (f'<animation id="{id}">{text}<sampler id="{id}-s"{behaviour}>{inputs}</sampler>'
            f'<channel source="#{id}-s" target="{target}"/></animation>\n')


# --- skins and morphs

IDENTITY = (1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1)


def skin(joints, *, mesh="house", array="Name_array", kind="name", id="skin", shape="", inverses=None):
    """The lower points (y < 0) follow the first joint, the others the second."""
    v = flat((0, 0) if y < 0 else (1, 0) for _, y, _ in POINTS)
    return (f'<controller id="{id}"><skin source="#{mesh}">{shape}'
            + source(f"{id}-j", joints, ["JOINT"], array, kind)
            + matrices(f"{id}-b", inverses or [IDENTITY, (1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1)])
            + source(f"{id}-w", [(1,)], ["WEIGHT"])
            + f'<joints><input semantic="JOINT" source="#{id}-j"/><input semantic="INV_BIND_MATRIX" '
              f'source="#{id}-b"/></joints><vertex_weights count="{len(POINTS)}"><input semantic="JOINT" '
              f'source="#{id}-j" offset="0"/><input semantic="WEIGHT" source="#{id}-w" offset="1"/>'
              f'<vcount>{numbers([1] * len(POINTS))}</vcount><v>{numbers(v)}</v></vertex_weights></skin>'
              '</controller>\n')


def joints(turn=25, names=("low", "high"), attribute="sid"):
    return (f'<node id="{"bone-low" if attribute != "id" else names[0]}" '
            f'{attribute + "=" + chr(34) + names[0] + chr(34) if attribute != "id" else ""} type="JOINT">'
            f'<node id="{"bone-high" if attribute != "id" else names[1]}" '
            f'{attribute + "=" + chr(34) + names[1] + chr(34) if attribute != "id" else ""} type="JOINT">'
            f'<rotate sid="turn">0 0 1 {turn}</rotate></node></node>\n')


def morph(targets, weights, *, method="NORMALIZED", mesh="house", id="morph"):
    return (f'<controller id="{id}"><morph source="#{mesh}" method="{method}">'
            + source(f"{id}-t", targets, ["MORPH_TARGET"], "IDREF_array", "IDREF")
            + source(f"{id}-w", [(w,) for w in weights], ["MORPH_WEIGHT"])
            + f'<targets><input semantic="MORPH_TARGET" source="#{id}-t"/><input semantic="MORPH_WEIGHT" '
              f'source="#{id}-w"/></targets></morph></controller>\n')
