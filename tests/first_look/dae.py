"""Writes COLLADA documents the way exporters do: tests/first_look/corpus.py chooses the ways."""
import dataclasses
from pathlib import Path

import shapes

SPACES = {
    "1.4.0": "http://www.collada.org/2005/11/COLLADASchema",
    "1.4.1": "http://www.collada.org/2005/11/COLLADASchema",
    "1.5.0": "http://www.collada.org/2008/03/COLLADASchema",
}
IDENTITY = (1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1)
PLACES = {"Z_UP": lambda p: p, "Y_UP": lambda p: (p[0], p[2], -p[1]), "X_UP": lambda p: (p[2], -p[0], -p[1])}


def num(v, digits=6):
    text = f"{v:.{digits}f}".rstrip("0").rstrip(".")
    return "0" if text in ("-0", "") else text


def nums(values, digits=6):
    return " ".join(num(v, digits) for v in values)


def matrix(values, sid=""):
    return f"<matrix{sid and f' sid={chr(34)}{sid}{chr(34)}'}>{nums(values)}</matrix>"


def translate(x, y, z):
    return f"<translate>{nums((x, y, z))}</translate>"


def rotate(axis, degrees, sid=None):
    return f"<rotate sid=\"{sid or 'rotate' + axis}\">{ {'X': '1 0 0', 'Y': '0 1 0', 'Z': '0 0 1'}[axis]} {num(degrees)}</rotate>"


def colour(name, value, sid=False):
    rgba = tuple(value) + ((1,) if len(value) == 3 else ())
    return f"<{name}><color{f' sid={chr(34)}{name}{chr(34)}' if sid else ''}>{nums(rgba)}</color></{name}>"


def amount(name, value):
    return f"<{name}><float>{num(value)}</float></{name}>"


def extra(profile, body):
    return f'<extra><technique profile="{profile}">{body}</technique></extra>'


@dataclasses.dataclass
class Look:
    """A material: diffuse is a colour or an image id; None leaves an element out."""

    diffuse: object = (0.6, 0.6, 0.6)
    model: str = "lambert"
    ambient: object = None
    emission: object = None
    specular: object = None
    shininess: object = None
    reflective: object = None
    reflectivity: object = None
    transparent: object = None  # a colour, or an image id
    opaque: str = ""
    transparency: object = None
    double_sided: object = None
    sids: bool = False
    direct: bool = False  # <texture> names the <image>, without surface and sampler
    texcoord: str = "UVSET0"
    more: str = ""

    def effect(self, ident, version):
        params = "".join(
            self.sampler(i, version)
            for i in dict.fromkeys(x for x in (self.diffuse, self.transparent, self.emission) if isinstance(x, str))
        )
        body = ""
        for name in (
            "emission",
            "ambient",
            "diffuse",
            "specular",
            "shininess",
            "reflective",
            "reflectivity",
            "transparent",
            "transparency",
        ):
            value = getattr(self, name)
            if (
                value is None
                or (self.model == "lambert" and name in ("specular", "shininess"))
                or (self.model == "constant" and name in ("ambient", "diffuse", "specular", "shininess"))
            ):
                continue
            if name == "transparent":
                mode = f' opaque="{self.opaque}"' if self.opaque else ""
                body += f"<transparent{mode}>{self.texture(value) if isinstance(value, str) else f'<color>{nums(tuple(value) + (1,) * (4 - len(value)))}</color>'}</transparent>"
            elif isinstance(value, str):
                body += f"<{name}>{self.texture(value)}</{name}>"
            elif isinstance(value, (int, float)):
                body += amount(name, value)
            else:
                body += colour(name, value, self.sids)
        sides = (
            ""
            if self.double_sided is None
            else extra("GOOGLEEARTH", f"<double_sided>{self.double_sided}</double_sided>")
        )
        return (
            f'<effect id="{ident}-fx" name="{ident}"><profile_COMMON>{params}<technique sid="common"><{self.model}>{body}</{self.model}>{sides}</technique>{self.more}'
            "</profile_COMMON></effect>\n"
        )

    def texture(self, image):
        return f'<texture texture="{image if self.direct else image + "-sampler"}" texcoord="{self.texcoord}"/>'

    def sampler(self, image, version):
        if self.direct:
            return ""
        if version == "1.5.0":
            return (
                f'<newparam sid="{image}-sampler"><sampler2D><instance_image url="#{image}"/></sampler2D></newparam>'
            )
        return (
            f'<newparam sid="{image}-surface"><surface type="2D"><init_from>{image}</init_from></surface></newparam>'
            f'<newparam sid="{image}-sampler"><sampler2D><source>{image}-surface</source></sampler2D></newparam>'
        )


class Rows:
    """Values of an array, each once."""

    def __init__(self):
        self.rows, self.at = [], {}

    def add(self, value, digits=5):
        key = tuple(round(c, digits) for c in value)
        if key not in self.at:
            self.at[key] = len(self.rows)
            self.rows.append(key)
        return self.at[key]


def source(ident, rows, params, digits=6):
    flat = [c for row in rows for c in row]
    named = "".join(f'<param name="{p}" type="float"/>' for p in params)
    return (
        f'<source id="{ident}"><float_array id="{ident}-array" count="{len(flat)}">{nums(flat, digits)}</float_array><technique_common>'
        f'<accessor source="#{ident}-array" count="{len(rows)}" stride="{len(params)}">{named}</accessor></technique_common></source>\n'
    )


def names(ident, words, param, kind="Name"):
    return (
        f'<source id="{ident}"><{kind}_array id="{ident}-array" count="{len(words)}">{" ".join(words)}</{kind}_array><technique_common>'
        f'<accessor source="#{ident}-array" count="{len(words)}" stride="1"><param name="{param}" type="{kind}"/></accessor></technique_common></source>\n'
    )


def tagged(points, point, colour_of):
    return colour_of(points[point])


@dataclasses.dataclass
class Ways:
    """How a mesh is written."""

    kind: str = "triangles"  # triangles, polylist, polygons, trifans, lines
    normals: str = "flat"  # none, flat, smooth; "vertices": smooth ones in <vertices>
    uv: bool = True
    one_index: bool = False  # a row of each array a corner, and one index for all
    symbol: object = str  # material -> symbol; None: no attribute
    scale: float = 1.0
    offset: tuple = (0, 0, 0)
    up: str = "Z_UP"
    both: bool = False  # back faces are written too
    colours: object = None  # point -> colour, written as COLOR
    uv_set: str = "0"
    v_down: bool = False
    digits: int = 6


def geometry(ident, mesh, ways):
    place = PLACES[ways.up]
    points = [tuple(c * ways.scale + o for c, o in zip(place(p), ways.offset)) for p in mesh.points]
    faces = list(mesh.faces)
    if ways.both:
        faces += [(tuple(reversed(f)), m, tuple(reversed(uv))) for f, m, uv in faces]
    if ways.kind == "triangles":
        faces = [
            ((f[0], f[k], f[k + 1]), m, (uv[0], uv[k], uv[k + 1])) for f, m, uv in faces for k in range(1, len(f) - 1)
        ]
    smooth = mesh.smooth_normals() if ways.normals in ("smooth", "vertices") else None
    normals, uvs, colours, groups = Rows(), Rows(), Rows(), {}
    merged, arrays = Rows(), []
    for face, material, uv in faces:
        flat, corners = shapes.unit(mesh.face_normal(tuple(face))), []
        for k, c in enumerate(face):
            n = place(smooth[c] if smooth else flat)
            st = (uv[k][0], 1 - uv[k][1]) if ways.v_down else uv[k]
            if ways.one_index:
                item = merged.add(points[c] + tuple(n) + tuple(st), ways.digits)
                corners.append([item])
                continue
            item = [c]
            if ways.normals in ("flat", "smooth"):
                item.append(normals.add(n))
            if ways.uv:
                item.append(uvs.add(st, 4))
            if ways.colours:
                item.append(colours.add(ways.colours(mesh.points[c]), 4))
            corners.append(item)
        groups.setdefault(material, []).append(corners)
    text = ""
    if ways.one_index:
        arrays = [
            ("POSITION", [r[:3] for r in merged.rows], "XYZ"),
            ("NORMAL", [r[3:6] for r in merged.rows], "XYZ"),
        ] + ([("TEXCOORD", [r[6:] for r in merged.rows], "ST")] if ways.uv else [])
        if ways.normals == "none":
            arrays.pop(1)
        text += "".join(source(f"{ident}-{s.lower()}", rows, params, ways.digits) for s, rows, params in arrays)
    else:
        text += source(f"{ident}-position", points, "XYZ", ways.digits)
        if ways.normals == "vertices":
            text += source(f"{ident}-normal", [place(n) for n in smooth], "XYZ")
        elif ways.normals != "none":
            text += source(f"{ident}-normal", normals.rows, "XYZ")
        if ways.uv:
            text += source(f"{ident}-texcoord", uvs.rows, "ST")
        if ways.colours:
            text += source(f"{ident}-color", colours.rows, "RGBA" if len(colours.rows[0]) == 4 else "RGB")
    within = (
        f'<input semantic="NORMAL" source="#{ident}-normal"/>'
        if ways.normals == "vertices" and not ways.one_index
        else ""
    )
    text += f'<vertices id="{ident}-vertices"><input semantic="POSITION" source="#{ident}-position"/>{within}</vertices>\n'
    inputs, offset = f'<input semantic="VERTEX" source="#{ident}-vertices" offset="0"/>', 1
    if ways.one_index:
        inputs += "".join(
            f'<input semantic="{s}" source="#{ident}-{s.lower()}" offset="0"{" set=" + chr(34) + ways.uv_set + chr(34) if s == "TEXCOORD" else ""}/>'
            for s, _, _ in arrays[1:]
        )
    else:
        for semantic, wanted in (
            ("NORMAL", ways.normals in ("flat", "smooth")),
            ("TEXCOORD", ways.uv),
            ("COLOR", ways.colours),
        ):
            if wanted:
                number = f' set="{ways.uv_set}"' if semantic == "TEXCOORD" else ""
                inputs += (
                    f'<input semantic="{semantic}" source="#{ident}-{semantic.lower()}" offset="{offset}"{number}/>'
                )
                offset += 1
    for material, polys in groups.items():
        text += primitive(
            ways.kind, polys, "" if ways.symbol is None else f' material="{ways.symbol(material)}"', inputs
        )
    return f'<geometry id="{ident}" name="{ident}"><mesh>\n{text}</mesh></geometry>\n'


def primitive(kind, polys, material, inputs):
    lists = [" ".join(str(i) for c in poly for i in c) for poly in polys]
    if kind == "triangles":
        return f'<triangles count="{len(polys)}"{material}>{inputs}<p>{" ".join(lists)}</p></triangles>\n'
    if kind == "polylist":
        return f'<polylist count="{len(polys)}"{material}>{inputs}<vcount>{" ".join(str(len(p)) for p in polys)}</vcount><p>{" ".join(lists)}</p></polylist>\n'
    if kind == "lines":
        pairs = [
            f"{' '.join(map(str, a))} {' '.join(map(str, b))}"
            for poly in polys
            for a, b in zip(poly, poly[1:] + poly[:1])
        ]
        return f'<lines count="{len(pairs)}"{material}>{inputs}<p>{" ".join(pairs)}</p></lines>\n'
    return f'<{kind} count="{len(polys)}"{material}>{inputs}{"".join(f"<p>{p}</p>" for p in lists)}</{kind}>\n'


class Document:
    def __init__(self, tool, meter=1, unit="meter", up="Z_UP", version="1.4.1", contributor="", asset=None):
        self.version, self.up, self.meter = version, up, meter
        self.libraries, self.scene, self.joints = {}, "", []
        self.order = [
            "images",
            "effects",
            "materials",
            "geometries",
            "controllers",
            "animations",
            "lights",
            "cameras",
            "nodes",
            "visual_scenes",
        ]
        self.asset = (
            asset
            if asset is not None
            else (
                f"<asset><contributor>{contributor}<authoring_tool>{tool}</authoring_tool></contributor><created>2011-05-06T07:08:09Z</created>"
                f'<modified>2011-05-06T07:08:09Z</modified><unit meter="{meter}" name="{unit}"/><up_axis>{up}</up_axis></asset>'
            )
        )
        self.looks = {}

    def put(self, library, text):
        self.libraries[library] = self.libraries.get(library, "") + text

    def image(self, ident, reference):
        inner = (
            f"<init_from><ref>{reference}</ref></init_from>"
            if self.version == "1.5.0"
            else f"<init_from>{reference}</init_from>"
        )
        self.put("images", f'<image id="{ident}" name="{ident}">{inner}</image>\n')
        return ident

    def look(self, name, look):
        self.looks[name] = look
        self.put("effects", look.effect(name, self.version))
        self.put(
            "materials",
            f'<material id="{name}-material" name="{name}"><instance_effect url="#{name}-fx"/></material>\n',
        )

    def palette(self, colours, **more):
        for name, value in colours.items():
            self.look(name, Look(diffuse=value, **more))

    def mesh(self, ident, mesh, **ways):
        ways.setdefault("up", self.up)
        ways.setdefault("scale", 1 / self.meter)
        self.put("geometries", geometry(ident, mesh, Ways(**ways)))
        return ident

    def bind(self, used, symbol=str, texcoord=None, uv_set="0"):
        text = ""
        for name in used:
            look = self.looks.get(name)
            textured = look and isinstance(look.diffuse, str)
            inner = (
                f'<bind_vertex_input semantic="{texcoord or look.texcoord}" input_semantic="TEXCOORD" input_set="{uv_set}"/>'
                if textured
                else ""
            )
            text += (
                f'<instance_material symbol="{symbol(name)}" target="#{name}-material">{inner}</instance_material>'
            )
        return f"<bind_material><technique_common>{text}</technique_common></bind_material>"

    def node(self, ident, inner, transforms="", kind=""):
        return f'<node id="{ident}" name="{ident}"{kind and f" type={chr(34)}{kind}{chr(34)}"}>{transforms}{inner}</node>\n'

    def add(self, text):
        self.scene += text

    def show(self, ident, mesh, transforms="", used=None, bind=None, **ways):
        """A mesh of its own under a node of its own, everything bound."""
        self.mesh(ident, mesh, **ways)
        symbol = ways.get("symbol", str) or str
        material = (
            self.bind(used or mesh.materials(), symbol, uv_set=ways.get("uv_set", "0")) if bind is None else bind
        )
        self.add(
            self.node(
                f"{ident}-node", f'<instance_geometry url="#{ident}">{material}</instance_geometry>', transforms
            )
        )

    def light(self, ident, kind, rgb, transforms, more=""):
        self.put(
            "lights",
            f'<light id="{ident}-light" name="{ident}"><technique_common><{kind}><color>{nums(rgb)}</color>{more if not more.startswith("<extra") else ""}</{kind}></technique_common>{more if more.startswith("<extra") else ""}</light>\n',
        )
        self.add(self.node(ident, f'<instance_light url="#{ident}-light"/>', transforms))

    def camera(
        self,
        ident,
        transforms,
        body="<perspective><yfov>37.8</yfov><aspect_ratio>1.333333</aspect_ratio><znear>0.1</znear><zfar>1000</zfar></perspective>",
    ):
        self.put(
            "cameras",
            f'<camera id="{ident}-camera" name="{ident}"><optics><technique_common>{body}</technique_common></optics></camera>\n',
        )
        self.add(self.node(ident, f'<instance_camera url="#{ident}-camera"/>', transforms))

    def skin(
        self,
        ident,
        mesh,
        joints,
        joint_of,
        roots,
        ids=None,
        armature="",
        shape=IDENTITY,
        used=None,
        scene=True,
        weights=1.0,
        **ways,
    ):
        """joints: name -> (parent, place in metres). roots: the <skeleton> references. ids: joint -> node id."""
        ways.setdefault("up", self.up)
        ways.setdefault("scale", 1 / self.meter)
        self.mesh(ident, mesh, **ways)
        place, s, order = PLACES[ways["up"]], ways["scale"], list(joints)
        inverse = []
        for name in order:
            x, y, z = (c * s for c in place(joints[name][1]))
            inverse.append((1, 0, 0, -x, 0, 1, 0, -y, 0, 0, 1, -z, 0, 0, 0, 1))
        n = len(mesh.points)
        self.put(
            "controllers",
            f'<controller id="{ident}-skin"><skin source="#{ident}"><bind_shape_matrix>{nums(shape)}</bind_shape_matrix>'
            + names(f"{ident}-joints", order, "JOINT")
            + f'<source id="{ident}-binds"><float_array id="{ident}-binds-array" count="{16 * len(order)}">{" ".join(nums(m) for m in inverse)}</float_array><technique_common><accessor source="#{ident}-binds-array" count="{len(order)}" stride="16"><param name="TRANSFORM" type="float4x4"/></accessor></technique_common></source>'
            + source(f"{ident}-weights", [(weights,)], ["WEIGHT"])
            + f'<joints><input semantic="JOINT" source="#{ident}-joints"/><input semantic="INV_BIND_MATRIX" source="#{ident}-binds"/></joints>'
            f'<vertex_weights count="{n}"><input semantic="JOINT" source="#{ident}-joints" offset="0"/><input semantic="WEIGHT" source="#{ident}-weights" offset="1"/><vcount>{" ".join(["1"] * n)}</vcount><v>{" ".join(f"{order.index(joint_of(p))} 0" for p in mesh.points)}</v></vertex_weights></skin></controller>\n',
        )

        def joint(name):
            parent, at = joints[name]
            origin = joints[parent][1] if parent else (0, 0, 0)
            move = tuple(c * s for c in place(tuple(a - b for a, b in zip(at, origin))))
            inner = "".join(joint(k) for k in order if joints[k][0] == name)
            return f'<node id="{ids(name) if ids else name}" name="{name}" sid="{name}" type="JOINT">{matrix((1, 0, 0, move[0], 0, 1, 0, move[1], 0, 0, 1, move[2], 0, 0, 0, 1), "transform")}{inner}</node>\n'

        tree = "".join(joint(k) for k in order if joints[k][0] is None)
        instance = f'<instance_controller url="#{ident}-skin">{"".join(f"<skeleton>#{r}</skeleton>" for r in roots)}{self.bind(used or mesh.materials(), ways.get("symbol", str) or str)}</instance_controller>'
        if scene:
            self.add(tree + self.node(f"{ident}-node", instance, armature))
        return tree, instance

    def text(self, scene_id="Scene"):
        if self.scene is not None:
            self.put(
                "visual_scenes", f'<visual_scene id="{scene_id}" name="{scene_id}">\n{self.scene}</visual_scene>\n'
            )
        body = "".join(
            f"<library_{name}>\n{self.libraries[name]}</library_{name}>\n"
            for name in self.order
            if name in self.libraries
        )
        end = f'<scene><instance_visual_scene url="#{scene_id}"/></scene>\n' if self.scene is not None else ""
        return f'<?xml version="1.0" encoding="utf-8"?>\n<COLLADA xmlns="{SPACES[self.version]}" version="{self.version}">\n{self.asset}\n{body}{end}</COLLADA>\n'

    def write(self, path):
        path = Path(path)
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(self.text(), encoding="utf-8")
