"""tests/programs/written_scenes.py: small COLLADA scenes for tests that render them, and what their
pictures show. A square [-1,1] in z = 0 under an orthographic camera of [-2,2]: 16 of 32 pixels."""
import sys

from programs import SOURCE, ProgramTest, render

sys.path.insert(0, str(SOURCE / "scripts/sheet"))
import png  # noqa: E402

HEAD = ('<?xml version="1.0"?><COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">'
        '<asset><created>2026-01-01T00:00:00Z</created><modified>2026-01-01T00:00:00Z</modified>'
        '<unit meter="{meter}"/><up_axis>{up}</up_axis></asset>')
SCENE = "<scene><instance_visual_scene url=\"#vs\"/></scene>"
BIND = ('<bind_material><technique_common><instance_material symbol="m" target="#mat">{}</instance_material>'
        '</technique_common></bind_material>')


def document(libraries, nodes="", meter=1, up="Y_UP"):
    """A file; one without nodes is for others to refer to."""
    scene = f'<library_visual_scenes><visual_scene id="vs">{nodes}</visual_scene></library_visual_scenes>{SCENE}'
    return HEAD.format(meter=meter, up=up) + libraries + (scene if nodes else "") + "</COLLADA>"


def source(id, numbers, width, names="XYZW", kind="float"):
    numbers = str(numbers).split() if isinstance(numbers, str) else [repr(n) for n in numbers]
    params = "".join(f'<param name="{names[k % len(names)]}" type="{kind}"/>' for k in range(width if width < 16 else 1))
    if width == 16:
        params = '<param name="TRANSFORM" type="float4x4"/>'
    array = {"name": "Name_array", "IDREF": "IDREF_array"}.get(kind, "float_array")
    return (f'<source id="{id}"><{array} id="{id}-a" count="{len(numbers)}">{" ".join(numbers)}</{array}>'
            f'<technique_common><accessor source="#{id}-a" count="{len(numbers) // width}" stride="{width}">'
            f'{params}</accessor></technique_common></source>')


def mesh(id, positions, triangles, uv=None):
    text = source(f"{id}-p", positions, 3)
    inputs = f'<input semantic="VERTEX" source="#{id}-v" offset="0"/>'
    if uv:
        text += source(f"{id}-t", uv, 2, "ST")
        inputs += f'<input semantic="TEXCOORD" source="#{id}-t" offset="0" set="0"/>'
    return (f'<geometry id="{id}"><mesh>{text}<vertices id="{id}-v"><input semantic="POSITION" source="#{id}-p"/>'
            f'</vertices><triangles count="{len(triangles) // 3}" material="m">{inputs}'
            f'<p>{" ".join(map(str, triangles))}</p></triangles></mesh></geometry>')


def geometries(*meshes):
    return f"<library_geometries>{''.join(meshes)}</library_geometries>"


def square(id="square", half=1.0):
    return mesh(id, [-half, -half, 0, half, -half, 0, half, half, 0, -half, half, 0], [0, 1, 2, 0, 2, 3],
                [0, 0, 1, 0, 1, 1, 0, 1])


def camera(optics="<orthographic><xmag>{m}</xmag><ymag>{m}</ymag><znear>{n}</znear><zfar>{f}</zfar></orthographic>",
           unit=1.0, distance=5.0):
    """The camera, and the node that has it."""
    text = optics.format(m=2 * unit, n=0.1 * unit, f=100 * unit)
    return (f'<library_cameras><camera id="cam"><optics><technique_common>{text}</technique_common></optics></camera>'
            '</library_cameras>',
            f'<node id="eye"><translate>0 0 {distance * unit}</translate><instance_camera url="#cam"/></node>')


CAMERA, EYE = camera()


def common(model="constant", slot="emission"):
    return ('<library_effects><effect id="fx"><profile_COMMON><technique sid="c">'
            f'<{model}><{slot}><color>1 1 1 1</color></{slot}></{model}></technique></profile_COMMON></effect>'
            '</library_effects><library_materials><material id="mat"><instance_effect url="#fx"/></material>'
            '</library_materials>')


WHITE, MATTE = common(), common("lambert", "diffuse")


def rsl(code, newparams="", binds=""):
    return (f'<library_effects><effect id="fx">{newparams}<profile_RSL><technique sid="t"><code><![CDATA[{code}]]></code>'
            f'<pass><shader stage="SURFACE">{binds}</shader></pass></technique></profile_RSL></effect>'
            '</library_effects><library_materials><material id="mat"><instance_effect url="#fx"/></material>'
            '</library_materials>')


def place(transforms="", url="#square", kind="geometry", id="node", inside="", skeleton=""):
    return (f'<node id="{id}">{transforms}<instance_{kind} url="{url}">{skeleton}{BIND.format(inside)}'
            f"</instance_{kind}></node>")


def animation(id, target, times, values, width=1, interpolation="LINEAR"):
    return (f'<animation id="{id}">{source(id + "-i", times, 1, "T")}{source(id + "-o", values, width)}'
            f'{source(id + "-k", " ".join([interpolation] * len(times)), 1, "I", "name")}'
            f'<sampler id="{id}-s"><input semantic="INPUT" source="#{id}-i"/>'
            f'<input semantic="OUTPUT" source="#{id}-o"/><input semantic="INTERPOLATION" source="#{id}-k"/></sampler>'
            f'<channel source="#{id}-s" target="{target}"/></animation>')


def animations(*all):
    return f"<library_animations>{''.join(all)}</library_animations>"


def controllers(*all):
    return f"<library_controllers>{''.join(all)}</library_controllers>"


def one_joint_skin(mesh_id, bind_shape, vertices=4):
    """A skin of one joint `j`, whose inverse bind matrix is the identity."""
    text = (source("skin-j", "j", 1, "J", "name") + source("skin-b", "1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1", 16) +
            source("skin-w", [1], 1, "W"))
    return (f'<controller id="skin"><skin source="#{mesh_id}"><bind_shape_matrix>{bind_shape}</bind_shape_matrix>{text}'
            '<joints><input semantic="JOINT" source="#skin-j"/><input semantic="INV_BIND_MATRIX" source="#skin-b"/></joints>'
            f'<vertex_weights count="{vertices}"><input semantic="JOINT" source="#skin-j" offset="0"/>'
            f'<input semantic="WEIGHT" source="#skin-w" offset="1"/><vcount>{"1 " * vertices}</vcount>'
            f'<v>{"0 0 " * vertices}</v></vertex_weights></skin></controller>')


def morph(base, target, weight=0):
    text = source("morph-t", target, 1, "T", "IDREF") + source("morph-w", [weight], 1, "W")
    return (f'<controller id="morph"><morph source="#{base}" method="NORMALIZED">{text}<targets>'
            '<input semantic="MORPH_TARGET" source="#morph-t"/><input semantic="MORPH_WEIGHT" source="#morph-w"/>'
            "</targets></morph></controller>")


class SceneTest(ProgramTest):
    def render(self, text, *words, code=0, out="a.png", name="scene.dae"):
        """32 x 32 pixels in the numbers that shaders write."""
        return self.expect(render(self.write(name, text), "-o", self.folder / out, "--size", "32x32", "--spp", "4",
                                  "--filter", "box", "--color", "legacy", "--threads", "2", "--progress", "none",
                                  *words), code)

    def pixel(self, name="a.png", x=16, y=16):
        return tuple(png.read(self.folder / name)[2][y][3 * x:3 * x + 3])

    def bytes_of(self, name):
        return [list(row) for row in png.read(self.folder / name)[2]]

    def box(self, name="a.png"):
        """Pixels that are not black: how many, from and to x, from and to y."""
        width, height, rows = png.read(self.folder / name)
        lit = [(x, y) for y in range(height) for x in range(width) if any(rows[y][3 * x:3 * x + 3])]
        if not lit:
            return None
        xs, ys = [x for x, _ in lit], [y for _, y in lit]
        return len(lit), min(xs), max(xs), min(ys), max(ys)
