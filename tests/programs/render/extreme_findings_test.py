"""tests/programs/render/extreme_findings_test.py: cases of tests/promises whose outcome is a finding: severity, code and
place, as kinora-render tells them."""
import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from programs import ProgramTest, main, render
from written_scenes import (CAMERA, EYE, WHITE, animation, animations, camera, controllers, document, geometries, mesh,
                            one_joint_skin, place, rsl, square)

IDENTITY = "1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1"
MOVED = place('<translate sid="t">0 0 0</translate>')


def scene(libraries=None, nodes=None, cam=(CAMERA, EYE), look=WHITE):
    return document(cam[0] + look + (libraries or geometries(square())), cam[1] + (nodes or place()))


def keyed(times, values, tangents=None):
    text = animation("a", "node/t.X", times, values, interpolation="BEZIER" if tangents else "LINEAR")
    if tangents:
        sources = "".join(f'<source id="a-{name}"><float_array id="a-{name}-a" count="{len(numbers)}">'
                          f'{" ".join(map(str, numbers))}</float_array><technique_common><accessor source="#a-{name}-a" '
                          f'count="{len(numbers) // 2}" stride="2"><param name="X" type="float"/>'
                          '<param name="Y" type="float"/></accessor></technique_common></source>'
                          for name, numbers in zip(("in", "out"), tangents))
        inputs = '<input semantic="IN_TANGENT" source="#a-in"/><input semantic="OUT_TANGENT" source="#a-out"/>'
        text = text.replace("<sampler", sources + "<sampler").replace("</sampler>", inputs + "</sampler>")
    return scene(geometries(square()) + animations(text), MOVED)


def skinned(*changes):
    skin = one_joint_skin("square", IDENTITY)
    for before, after in changes:
        assert before in skin, before
        skin = skin.replace(before, after)
    joint = '<node id="j" sid="j" type="JOINT"/>'
    return scene(geometries(square()) + controllers(skin),
                 joint + place(url="#skin", kind="controller", skeleton="<skeleton>#j</skeleton>"))


def shaded(code):
    return scene(look=rsl(code))


def triangle(positions, indices=(0, 1, 2)):
    return scene(geometries(mesh("square", positions, list(indices))))


def seen_by(optics):
    return scene(cam=camera(optics))


def perspective(fov=40, aspect=1, near=0.1, far=100):
    return seen_by(f"<perspective><xfov>{fov}</xfov><aspect_ratio>{aspect}</aspect_ratio><znear>{near}</znear>"
                   f"<zfar>{far}</zfar></perspective>")


SQUARE = [0, 0, 0, 1, 0, 0, 0, 1, 0]
# Number of the case in promises.table ("law": what holds for all of them), severity, code, what stands at the place that
# is named, the document, and options.
CASES = (
    (3, "warning", "GEOMETRY_ISSUE", '<geometry id="square"', triangle([0, 0, 0, 1e19, 0, 0, 0, 1, 0])),
    (5, "warning", "SRC_NAN_INF", "NaN 0 0 1", triangle("NaN 0 0 1 0 0 0 1 0 0 0 0", (0, 1, 2, 1, 2, 3))),
    (11, "warning", "NODE_SINGULAR", '<node id="node"', scene(nodes=place("<scale>0 1 1</scale>") + place(id="b"))),
    (14, "info", "NODE_MATRIX_ROW", "<matrix>", scene(nodes=place(f"<matrix>{IDENTITY[:-3]}0.5 1</matrix>"))),
    (19, "warning", "PRIM_INDEX_RANGE", "3</p>", triangle(SQUARE, (0, 1, 2, 0, 1, 3))),
    (23, "warning", "ANIM_TIME_ORDER", '<source id="a-i">', keyed([0, 2, 1], [0, 1, 2])),
    (25, "warning", "ANIM_KEYS_REPAIRED", '<sampler id="a-s">', keyed([0, 1], [0, 1], ([-1, 0, -5, 1], [9, 0, 1.5, 1]))),
    (27, "warning", "ANIM_KEY_NAN", '<sampler id="a-s">', keyed([0, 9999, 2], [0, 1, 2]).replace(" 9999 ", " NaN ")),
    (27, "warning", "ANIM_KEY_NAN", '<sampler id="a-s">', keyed([0, 1, 2], [0, 9999, 2]).replace(" 9999 ", " INF ")),
    (30, "warning", "NODE_VALUE", "<rotate>", scene(nodes=place("<rotate>0 0 0 45</rotate>"))),
    (35, "info", "SKIN_WEIGHT_SUM", '<controller id="skin">', skinned((">1</float_array>", ">0.9</float_array>"))),
    (36, "warning", "SKIN_ZERO_INFLUENCE", '<controller id="skin">',
     skinned(("<vcount>1 1 1 1 </vcount>", "<vcount>1 1 1 0 </vcount>"), ("<v>0 0 0 0 0 0 0 0 </v>", "<v>0 0 0 0 0 0 </v>"))),
    (37, "warning", "SRC_NAN_INF", "NaN</float_array>", skinned((">1</float_array>", ">NaN</float_array>"))),
    (19, "warning", "SKIN_INDEX", "<v>7 0", skinned(("<v>0 0 0 0", "<v>7 0 0 0"))),
    (41, "warning", "SKIN_IBM_SINGULAR", '<source id="skin-b">',
     skinned((IDENTITY + "</float_array>", "1 0 0 0 0 1 0 0 0 0 0 0 0 0 0 1</float_array>"))),
    (43, "warning", "LINK_CYCLE", '#loop"/>', scene(nodes=place() + '<node id="loop"><instance_node url="#loop"/></node>')),
    (66, "error", "RSL_NO_OVERLOAD", "spline(u", shaded("surface s() { Ci = spline(u, color(0), color(1), color(1)); }")),
    (71, "warning", "SHADER_FAULT", "a[5 +", shaded("surface s() { Oi = 1; float a[3] = {0, 1, 2}; Ci = a[5 + 10 * u]; }")),
    (71, "warning", "SHADER_FAULT", "a[k]", shaded("surface s(float k = 7) { Oi = 1; float a[3] = {0, 1, 2}; Ci = a[k]; }")),
    (71, "warning", "SHADER_FAULT", "a[u /", shaded("surface s() { Oi = 1; float a[3] = {0, 1, 2}; Ci = a[u / 0 - 1]; }")),
    (72, "warning", "SHADER_FAULT", "while (u", shaded("surface s() { Oi = 1; float i = 0; while (u < 9) i += 1; Ci = i; }")),
    (74, "warning", "SHADER_FAULT", "f(x + 1) + 1",
     shaded("float f(float x) { return f(x + 1) + 1; } surface s() { Oi = 1; Ci = f(u); }")),
    ("law", "warning", "SHADER_NON_FINITE", "s() {", shaded("surface s() { Oi = 1; Ci = color(1e30 * 1e30 * u, 0, 0); }")),
    (85, "warning", "CAM_FOV", "<xfov>180", perspective(fov=180)),
    (85, "error", "CAMERA_OPTICS", '<camera id="cam">', perspective(fov=180), "--camera", "cam"),
    (85, "warning", "CAM_FOV", "<xfov>0", perspective(fov=0)),
    (85, "error", "CAMERA_OPTICS", '<camera id="cam">', perspective(fov=0), "--camera", "cam"),
    (86, "warning", "CAM_Z", "<znear>5", perspective(near=5, far=5)),
    (86, "warning", "CAM_Z", "<znear>0", perspective(near=0)),
    (86, "warning", "CAM_Z", "<znear>9", perspective(near=9, far=1)),
    (87, "warning", "CAM_FOV", "<aspect_ratio>0", perspective(aspect=0)),
    (92, "warning", "SRC_NUMBER", "1.5.2 0", triangle("0 0 0 1.5.2 0 0 0 1 0")),
    (92, "warning", "SRC_NUMBER", "0x1p3 0", triangle("0 0 0 0x1p3 0 0 0 1 0")),
    (92, "warning", "SRC_NAN_INF", "1e999 0", triangle("0 0 0 1e999 0 0 0 1 0")),
    (92, "warning", "SRC_NAN_INF", "nan 0", triangle("0 0 0 nan 0 0 0 1 0")),
    (93, "info", "SRC_COUNT", "4000000000", scene().replace('count="12"', 'count="4000000000"')),
    (94, "info", "SRC_STRIDE", "0", scene().replace('stride="3"', 'stride="0"')),
    (94, "warning", "SRC_OFFSET", "999", scene().replace('stride="3"', 'stride="3" offset="999"')),
    (94, "warning", "SRC_OFFSET", "18446744073709551615",
     scene().replace('stride="3"', 'stride="3" offset="18446744073709551615"')),
)
# Of a finding as it is printed: file, line and column, or none of them; severity; code.
FINDING = re.compile(r"^(?:kinora|.*?:(\d+):(\d+)): (info|warning|error): .* \[(\w+)\]$", re.M)


class ExtremeFindings(ProgramTest):
    def findings(self, text, *words):
        """Severity, code and the text at its place, of all that is said of a document with a line for each element."""
        lines = text.replace("><", ">\n<")
        result = render(self.write("s.dae", lines), "-o", "null", "--size", "8x8", "--spp", "1", "--threads", "1",
                        "--progress", "none", "-v", *words)
        self.assertIn(result.code, (0, 1, 3, 4), result)
        said = []
        for line, column, severity, code in FINDING.findall(result.out + result.err):
            place = lines.split("\n")[int(line) - 1][int(column) - 1:] if line else ""
            said.append((severity, code, place))
        return said

    def test_code_place_and_severity(self):
        for number, severity, code, there, text, *words in CASES:
            with self.subTest(case=number, code=code, words=words):
                said = self.findings(text, *words)
                self.assertTrue(any(s == severity and c == code and at.startswith(there) for s, c, at in said), said)
                if code.startswith("SKIN_"):
                    self.assertEqual(sum(c == code for _, c, _ in said), 1, said)

    def test_what_is_sound_is_not_told(self):
        for text in (scene(), keyed([0, 1, 2], [0, 1, 2]), skinned(), perspective(), shaded("surface s() { Oi = 1; Ci = u; }"),
                     keyed([0, 1], [0, 1], ([-.5, 0, .5, 1], [.5, 0, 1.5, 1]))):
            self.assertEqual([said for said in self.findings(text) if said[0] != "info"], [])


if __name__ == "__main__":
    main()
