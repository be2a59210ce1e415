"""What the stranger's documents share: arrays, meshes, materials and the frame of a document, each as plain text."""
import math
import random

import shapes

DOCUMENTS = []  # (path, function that returns the text and may write pictures, expectations)
SPACE = {"1.4.0": "2005/11", "1.4.1": "2005/11", "1.5.0": "2008/03"}


def document(path, **expected):
    def keep(function):
        DOCUMENTS.append((path, function, expected))
        return function

    return keep


def write(folder):
    """Writes all documents below folder; path -> expectations."""
    for path, function, _ in DOCUMENTS:
        file = folder / path
        file.parent.mkdir(parents=True, exist_ok=True)
        text = function(file.parent)
        if isinstance(text, str):
            text = text.encode("utf-8")
        if text is not None:
            file.write_bytes(text)
    return {path: expected for path, _, expected in DOCUMENTS}


def paint(folder, name, pixel, channels=3, size=64):
    file = folder / name
    file.parent.mkdir(parents=True, exist_ok=True)
    pixel = shapes.paint_of(pixel) if isinstance(pixel, str) else pixel
    if file.suffix.lower() == ".tga":
        shapes.tga(file, size, size, pixel)
    elif file.suffix.lower() == ".bmp":
        shapes.bmp(file, size, size, pixel)
    else:
        shapes.png(file, size, size, pixel, channels)


def g(v):
    return f"{v:.6g}"


def row(values):
    return " ".join(map(g, values))


def y_up(p):
    return (p[0], p[2], -p[1])


def z_up(p):
    return tuple(p)


def scaled(place, k, offset=(0, 0, 0)):
    return lambda p: tuple(k * c + o for c, o in zip(place(p), offset))


def array(ident, rows, params, digits=6, kind="float"):
    flat = " ".join(f"{c:.{digits}g}" for r in rows for c in r)
    names = "".join(f'<param name="{p}" type="{kind}"/>' if p else f'<param type="{kind}"/>' for p in params)
    return (
        f'<source id="{ident}"><float_array id="{ident}-array" count="{len(rows) * len(params)}">{flat}</float_array>'
        f'<technique_common><accessor source="#{ident}-array" count="{len(rows)}" stride="{len(params)}">{names}</accessor>'
        "</technique_common></source>\n"
    )


def words(ident, values, param, kind="Name"):
    return (
        f'<source id="{ident}"><{kind}_array id="{ident}-array" count="{len(values)}">{" ".join(values)}</{kind}_array>'
        f'<technique_common><accessor source="#{ident}-array" count="{len(values)}" stride="1"><param name="{param}" '
        f'type="{kind}"/></accessor></technique_common></source>\n'
    )


def matrices(ident, rows):
    return array(ident, rows, ["TRANSFORM"], kind="float4x4").replace(
        f'count="{len(rows)}">', f'count="{16 * len(rows)}">', 1
    ).replace('stride="1"', 'stride="16"')


def triangulated(model):
    for face, material, uv in model.faces:
        for k in range(1, len(face) - 1):
            yield (face[0], face[k], face[k + 1]), material, (uv[0], uv[k], uv[k + 1])


def mesh(ident, model, place=z_up, kind="triangles", normals="flat", uv=True, colours=None, symbol=str, digits=6,
         texset=' set="0"', more="", wrap="mesh", mid=""):
    """<geometry> of a model of shapes.py.

    normals: flat, smooth (a row a corner), vertices (in <vertices>) or none. symbol: material -> symbol, or None for none.
    more: further text within <mesh>; mid: between sources and <vertices>."""
    points = [place(p) for p in model.points]
    text = array(f"{ident}-pos", points, "XYZ", digits)
    inputs, stride, extra = f'<input semantic="VERTEX" source="#{ident}-vtx" offset="0"/>', 1, ""
    at_zero = place((0, 0, 0))
    turn = lambda n: shapes.unit(tuple(a - b for a, b in zip(place(n), at_zero)))  # noqa: E731
    smooth = [turn(n) for n in model.smooth_normals()] if normals in ("smooth", "vertices") else None
    faces = list(triangulated(model)) if kind in ("triangles", "tristrips", "trifans") else list(model.faces)
    flat = [turn(shapes.unit(model.face_normal(tuple(f)))) for f, _, _ in faces]
    if normals in ("flat", "smooth"):
        text += array(f"{ident}-nrm", smooth or flat, "XYZ")
        inputs += f'<input semantic="NORMAL" source="#{ident}-nrm" offset="{stride}"/>'
        stride += 1
    elif normals == "vertices":
        text += array(f"{ident}-nrm", smooth, "XYZ")
        extra = f'<input semantic="NORMAL" source="#{ident}-nrm"/>'
    if uv:
        text += array(f"{ident}-uv", [c for _, _, cs in faces for c in cs], "ST")
        inputs += f'<input semantic="TEXCOORD" source="#{ident}-uv" offset="{stride}"{texset}/>'
        stride += 1
    if colours:
        rows = [colours(p) for p in model.points]
        text += array(f"{ident}-col", rows, "RGBA"[: len(rows[0])])
        inputs += f'<input semantic="COLOR" source="#{ident}-col" offset="{stride}" set="0"/>'
    corner, groups = 0, {}
    for i, (face, material, _) in enumerate(faces):
        corners = []
        for k in face:
            item = [k]
            item += [k if smooth else i] if normals in ("flat", "smooth") else []
            item += [corner] if uv else []
            item += [k] if colours else []
            corner += 1
            corners.append(" ".join(map(str, item)))
        groups.setdefault(material, []).append(corners)
    text += mid + f'<vertices id="{ident}-vtx"><input semantic="POSITION" source="#{ident}-pos"/>{extra}</vertices>\n'
    for material, polys in groups.items():
        named = f' material="{symbol(material)}"' if symbol else ""
        flatly = " ".join(c for poly in polys for c in poly)
        counts = " ".join(str(len(p)) for p in polys)
        if kind == "triangles":
            body = f"<p>{flatly}</p>"
        elif kind == "polylist":
            body = f"<vcount>{counts}</vcount><p>{flatly}</p>"
        else:
            body = "".join(f"<p>{' '.join(p)}</p>" for p in polys)
        text += f'<{kind}{named} count="{len(polys)}">{inputs}{body}</{kind}>\n'
    return f'<geometry id="{ident}" name="{ident}"><{wrap}>\n{text}{more}</{wrap}></geometry>\n'


def col(name, *rgba):
    return f"<{name}><color>{row(rgba if len(rgba) == 4 else (*rgba, 1))}</color></{name}>"


def num(name, value):
    return f"<{name}><float>{g(value)}</float></{name}>"


def tex(name, image, channel="UVMap"):
    return f'<{name}><texture texture="{image}-sampler" texcoord="{channel}"/></{name}>'


def sampler(image):
    return (
        f'<newparam sid="{image}-surface"><surface type="2D"><init_from>{image}</init_from></surface></newparam>'
        f'<newparam sid="{image}-sampler"><sampler2D><source>{image}-surface</source></sampler2D></newparam>'
    )


def effect(ident, body, model="phong", params="", more="", after=""):
    return (
        f'<effect id="{ident}-effect"><profile_COMMON>{params}<technique sid="common"><{model}>{body}</{model}>{more}'
        f"</technique>{after}</profile_COMMON></effect>\n"
    )


def material(ident):
    return f'<material id="{ident}" name="{ident}"><instance_effect url="#{ident}-effect"/></material>\n'


def image(ident, reference):
    return f'<image id="{ident}" name="{ident}"><init_from>{reference}</init_from></image>\n'


def bind(names, symbol=str, channel=None, input_set=0):
    inner = (
        f'<bind_vertex_input semantic="{channel}" input_semantic="TEXCOORD" input_set="{input_set}"/>' if channel else ""
    )
    return "<bind_material><technique_common>" + "".join(
        f'<instance_material symbol="{symbol(n)}" target="#{n}">{inner}</instance_material>' for n in names
    ) + "</technique_common></bind_material>"


def place_node(ident, geometry, binding, transforms="", attributes=""):
    return (
        f'<node id="{ident}" name="{ident}"{attributes}>{transforms}<instance_geometry url="#{geometry}">{binding}'
        "</instance_geometry></node>\n"
    )


def asset(tool, unit="meter", meter=1, up="Z_UP", comments=""):
    comments = comments and f"<comments>{comments}</comments>"
    return (
        f"<asset><contributor><author>someone</author><authoring_tool>{tool}</authoring_tool>{comments}</contributor>"
        f"<created>2009-04-01T10:11:12Z</created><modified>2009-04-01T10:11:12Z</modified>"
        + (f'<unit name="{unit}" meter="{meter}"/>' if unit else "")
        + (f"<up_axis>{up}</up_axis>" if up else "")
        + "</asset>\n"
    )


def collada(head, libraries, nodes, version="1.4.1", scene="VisualSceneNode", tail=""):
    """libraries: (name, text) pairs; nodes: the visual scene's content."""
    body = "".join(f"<library_{n}>\n{t}</library_{n}>\n" if t else f"<library_{n}/>\n" for n, t in libraries)
    return (
        f'<?xml version="1.0" encoding="utf-8"?>\n<COLLADA xmlns="http://www.collada.org/{SPACE[version]}/COLLADASchema" '
        f'version="{version}">\n{head}{body}<library_visual_scenes><visual_scene id="{scene}" name="{scene}">\n{nodes}'
        f'</visual_scene></library_visual_scenes>\n<scene><instance_visual_scene url="#{scene}"/>{tail}</scene>\n</COLLADA>\n'
    )


def phong(rgb, ambient=(0, 0, 0), specular=(0.3, 0.3, 0.3), shininess=20, emission=(0, 0, 0), more=""):
    return (
        col("emission", *emission) + col("ambient", *ambient) + col("diffuse", *rgb) + col("specular", *specular)
        + num("shininess", shininess) + more
    )


def lambert(rgb, more=""):
    return col("emission", 0, 0, 0) + col("ambient", 0, 0, 0) + col("diffuse", *rgb) + more


TINTS = {"wood": (0.5, 0.3, 0.15), "metal": (0.5, 0.5, 0.55), "cloth": (0.2, 0.3, 0.6), "red": (0.7, 0.1, 0.1),
         "green": (0.15, 0.5, 0.2), "wall": (0.8, 0.76, 0.7), "roof": (0.5, 0.22, 0.16), "glass": (0.4, 0.5, 0.6),
         "grass": (0.3, 0.45, 0.2), "skin": (0.9, 0.7, 0.58), "hair": (0.2, 0.12, 0.06), "trousers": (0.2, 0.2, 0.3),
         "shoes": (0.12, 0.1, 0.08), "paint": (0.65, 0.12, 0.1), "rubber": (0.1, 0.1, 0.1), "fur": (0.55, 0.4, 0.25),
         "glow": (1, 0.95, 0.8), "floor": (0.5, 0.5, 0.48), "gold": (0.8, 0.6, 0.2), "bark": (0.35, 0.25, 0.18),
         "leaves": (0.25, 0.5, 0.2)}


def painted(names, body=phong, model="phong", **more):
    """(effects, materials) of the usual colours."""
    return (
        "".join(effect(n, body(TINTS.get(n, (0.6, 0.6, 0.6)), **more), model) for n in names),
        "".join(material(n) for n in names),
    )


def lumps(seed=3):
    rng = random.Random(seed)
    out = shapes.Mesh()
    for _ in range(6):
        out.join(shapes.ball(rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(0.3, 0.8), 0.5, 0.4, 0.5, 12, 8, "red"))
    return out
