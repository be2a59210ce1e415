# scripts/assets/dae_writer.py: writes a COLLADA 1.4.1 file with profile_RSL, from Python values.
from contextlib import contextmanager
import math
import re


class Point(tuple):
    """Three numbers that are no color."""


def numbers(values):
    return " ".join(f"{v:.5g}" for v in values)


def grid_of(point, across, along):
    """point(s, t) on a grid of quads: (positions, texture coordinates, quads)."""
    positions, st, quads = [], [], []
    for j in range(along + 1):
        for i in range(across + 1):
            st.append((i / across, j / along))
            positions.append(point(*st[-1]))
    for j in range(along):
        for i in range(across):
            a = j * (across + 1) + i
            quads.append((a, a + 1, a + across + 2, a + across + 1))
    return positions, st, quads


def lathe_of(profile, around, along):
    """A surface of revolution about z: profile(t) gives (radius, z); s runs around, t along."""

    def point(s, t):
        radius, z = profile(t)
        return radius * math.cos(2 * math.pi * s), radius * math.sin(2 * math.pi * s), z

    return grid_of(point, around, along)


def smooth(points, t):
    """A Catmull-Rom curve through the points, t from 0 to 1."""
    at = t * (len(points) - 1)
    k = min(int(at), len(points) - 2)
    f = at - k
    a, b, c, d = (points[min(max(k + i, 0), len(points) - 1)] for i in (-1, 0, 1, 2))
    return 0.5 * (2 * b + (c - a) * f + (2 * a - 5 * b + 4 * c - d) * f * f + (3 * b - a - 3 * c + d) * f ** 3)


def smooth_normals(mesh):
    """Area-weighted; vertices at one place (the seam of a lathe, its poles) share theirs."""
    positions, _, quads = mesh
    sums = {}
    key = [tuple(round(c, 5) for c in p) for p in positions]
    for quad in quads:
        a, b, c, d = (positions[i] for i in quad)
        u, v = [c[i] - a[i] for i in range(3)], [d[i] - b[i] for i in range(3)]
        n = (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
        for i in quad:
            s = sums.setdefault(key[i], [0.0, 0.0, 0.0])
            for k in range(3):
                s[k] += n[k]
    normals = []
    for k in key:
        n = sums.get(k, (0, 0, 1))
        length = math.sqrt(sum(c * c for c in n)) or 1.0
        normals.append(tuple(c / length for c in n))
    return normals


def add_box(dae, name, material, low, high, transforms=()):
    """Six separate faces, so that edges stay sharp."""
    positions, st, quads = [], [], []
    for axis in range(3):
        for end in (0, 1):
            b, c = (axis + 1) % 3, (axis + 2) % 3
            first = len(positions)
            for s, t in ((0, 0), (1, 0), (1, 1), (0, 1)):
                p = [0.0, 0.0, 0.0]
                p[axis] = (low, high)[end][axis]
                p[b], p[c] = (low, high)[s][b], (low, high)[t][c]
                positions.append(tuple(p))
                st.append((s, t))
            quad = (first, first + 1, first + 2, first + 3)
            quads.append(quad if end else quad[::-1])
    dae.mesh(name, (positions, st, quads), material, flat=True)
    dae.node(name, name, material, transforms)


class Dae:
    def __init__(self):
        self.parts = {name: [] for name in ("cameras", "lights", "effects", "materials",
                                            "geometries", "animations")}
        self.nodes = []
        self.depth = 0
        self.scene_extra = ""  # of <visual_scene>: atmosphere, imager

    def material(self, name, stages, values):
        """stages: (stage, shader, code); a co-shader's stage is (handle,). The values are the effect's
        newparams and the material's setparams: a channel may target either. A list of texts, or
        one in a tuple, are handles for parameters of type shader."""
        handles = {k: v for k, v in values.items() if isinstance(v, (list, tuple)) and isinstance(v[0], str)}
        values = {k: v for k, v in values.items() if k not in handles}
        self.parts["materials"].append(
            f'<material id="{name}-material"><instance_effect url="#{name}-effect">'
            + "".join(f'<setparam ref="{k}">{self.value(v)}</setparam>' for k, v in values.items())
            + "</instance_effect></material>")
        self.effect(name, stages, values, handles)

    def light(self, name, shader, code, values):
        self.effect(name, [("LIGHT", shader, code)], values)
        self.parts["lights"].append(
            f'<light id="{name}-light"><technique_common><point><color>1 1 1</color></point>'
            f'</technique_common><extra><technique profile="RSL"><instance_effect '
            f'url="#{name}-effect"/></technique></extra></light>')

    def effect(self, name, stages, values, handles=()):
        params = "".join(f'<newparam sid="{k}">{self.value(v)}</newparam>'
                         for k, v in values.items())
        codes = "".join(f"<code><![CDATA[\n{code}]]></code>\n" for _, _, code in stages)
        shaders = "".join(
            (f'<shader stage="COSHADER" handle="{stage[0]}">' if isinstance(stage, tuple)
             else f'<shader stage="{stage}">') + f"<name>{shader}</name>"
            + "".join(f'<bind symbol="{k}">{self.handles(v)}</bind>' for k, v in dict(handles).items()
                      if self.declares(code, k))
            + "".join(f'<bind symbol="{k}"><param ref="{k}"/></bind>'
                      for k in values if self.declares(code, k)) + "</shader>\n"
            for stage, shader, code in stages)
        self.parts["effects"].append(
            f'<effect id="{name}-effect">{params}<profile_RSL><technique sid="default">\n{codes}'
            f"<pass>\n{shaders}</pass></technique></profile_RSL></effect>")

    @staticmethod
    def declares(code, parameter):
        return re.search(rf"\b{parameter}(\[\])?\s*=", re.split(r"\)\s*\{", code)[0]) is not None

    @staticmethod
    def handles(v):
        """Of a list of handles the whole; of a tuple its one."""
        texts = "".join(f"<string>{text}</string>" for text in v)
        return texts if isinstance(v, tuple) else f'<array length="{len(v)}">{texts}</array>'

    @staticmethod
    def value(v):
        """A number, a text, a color, or the three numbers of a Point."""
        if isinstance(v, str):
            return f"<string>{v}</string>"
        if isinstance(v, Point):
            return f"<float3>{numbers(v)}</float3>"
        return f"<color>{numbers(v)}</color>" if isinstance(v, tuple) else f"<float>{v:g}</float>"

    def source(self, id, rows, params, kind="float"):
        flat = [v for row in rows for v in row]
        text = numbers(flat) if kind == "float" else " ".join(flat)
        array = "float_array" if kind == "float" else "Name_array"
        names = "".join(f'<param name="{p}" type="{kind}"/>' for p in params)
        return (f'<source id="{id}"><{array} id="{id}-array" count="{len(flat)}">{text}</{array}>'
                f'<technique_common><accessor source="#{id}-array" count="{len(rows)}" '
                f'stride="{len(params)}">{names}</accessor></technique_common></source>\n')

    def mesh(self, name, mesh, material, flat=False):
        positions, st, quads = mesh
        text = self.source(name + "-p", positions, "XYZ")
        text += self.source(name + "-n", smooth_normals(mesh) if not flat else
                            face_normals(mesh), "XYZ")
        text += self.source(name + "-st", st, "ST")
        text += (f'<vertices id="{name}-v"><input semantic="POSITION" source="#{name}-p"/>'
                 f"</vertices>\n")
        text += f'<polylist material="{material}" count="{len(quads)}">'
        for semantic, source in (("VERTEX", "v"), ("NORMAL", "n"), ("TEXCOORD", "st")):
            text += f'<input semantic="{semantic}" source="#{name}-{source}" offset="0"/>'
        corners = " ".join(str(i) for quad in quads for i in quad)
        text += f'<vcount>{"4 " * len(quads)}</vcount><p>{corners}</p></polylist>'
        self.parts["geometries"].append(
            f'<geometry id="{name}-mesh"><mesh>\n{text}</mesh></geometry>')

    def line(self, text):
        self.nodes.append("  " * self.depth + text)

    def open_node(self, name, transforms):
        self.line(f'<node id="{name}">')
        for kind, sid, values in transforms:
            self.line(f'<{kind} sid="{sid}">{numbers(values)}</{kind}>')

    def node(self, name, mesh, material, transforms=()):
        self.open_node(name, transforms)
        self.line(f'<instance_geometry url="#{mesh}-mesh"><bind_material><technique_common>'
                  f'<instance_material symbol="{material}" target="#{material}-material"/>'
                  f"</technique_common></bind_material></instance_geometry></node>")

    @contextmanager
    def group(self, name, transforms):
        self.open_node(name, transforms)
        self.depth += 1
        yield
        self.depth -= 1
        self.line("</node>")

    def light_node(self, name, transforms=()):
        self.open_node(name + "-node", transforms)
        self.line(f'<instance_light url="#{name}-light"/></node>')

    def camera(self, name, xfov, aspect, transforms):
        self.parts["cameras"].append(
            f'<camera id="{name}-camera"><optics><technique_common><perspective><xfov>{xfov:g}'
            f"</xfov><aspect_ratio>{aspect:.6g}</aspect_ratio><znear>0.1</znear><zfar>50</zfar>"
            f"</perspective></technique_common></optics></camera>")
        self.open_node(name, transforms)
        self.line(f'<instance_camera url="#{name}-camera"/></node>')

    def channel(self, target, times, values):
        """values: numbers, or tuples of three."""
        name = target.replace("/", "-").replace(".", "-")
        rows = [v if isinstance(v, tuple) else (v,) for v in values]
        params = ["X", "Y", "Z"] if len(rows[0]) == 3 else ["VALUE"]
        text = self.source(name + "-t", [(t,) for t in times], ["TIME"])
        text += self.source(name + "-o", rows, params)
        text += self.source(name + "-i", [("LINEAR",)] * len(rows), ["INTERPOLATION"], "name")
        text += f'<sampler id="{name}-s">'
        for semantic, source in (("INPUT", "t"), ("OUTPUT", "o"), ("INTERPOLATION", "i")):
            text += f'<input semantic="{semantic}" source="#{name}-{source}"/>'
        text += f'</sampler><channel source="#{name}-s" target="{target}"/>'
        self.parts["animations"].append(f'<animation id="{name}">\n{text}</animation>')

    def write(self, path):
        libraries = "".join(f"<library_{name}>\n" + "\n".join(items) + f"\n</library_{name}>\n"
                            for name, items in self.parts.items() if items)
        with open(path, "w") as file:
            file.write(
                '<?xml version="1.0" encoding="utf-8"?>\n<COLLADA '
                'xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">\n'
                "<asset><created>2026-11-21T00:00:00Z</created><modified>2026-11-21T00:00:00Z"
                '</modified><unit name="decimeter" meter="0.1"/><up_axis>Z_UP</up_axis></asset>\n'
                + libraries + '<library_visual_scenes><visual_scene id="room">\n'
                + "\n".join(self.nodes) + f"\n{self.scene_extra}"
                "</visual_scene></library_visual_scenes>\n"
                '<scene><instance_visual_scene url="#room"/></scene>\n</COLLADA>\n')


def face_normals(mesh):
    """For meshes whose quads share no vertices."""
    positions, _, quads = mesh
    normals = [(0, 0, 1)] * len(positions)
    for quad in quads:
        one = smooth_normals((positions, None, [quad]))
        for i in quad:
            normals[i] = one[i]
    return normals
