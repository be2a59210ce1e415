"""tests/programs/seeds_test.py: the shaders printed in the documents of ../shared/seeds, typed in as a
reader would, compile and look right. KINORA_KEEP=FOLDER keeps the pictures."""
import os
import re
import shutil
import sys
import unittest
from pathlib import Path

from programs import SHARED, SOURCE, ProgramTest, main, render, shade

sys.path[:0] = [str(SOURCE / "scripts"), str(SOURCE / "scripts/assets")]
from dae_writer import Dae, Point, add_box, grid_of, lathe_of  # noqa: E402
from sheet import png  # noqa: E402
from sheet.stage import ball  # noqa: E402

SEEDS = SHARED / "seeds"

# The misprints of the article, each with what was meant; every one must be there.
MISPRINTS = {
    "marble": [],
    "windowlight": [
        ("windowlight {", "windowlight ("),
        ("to=       point(0, 0, 0)\n", "to=       point(0, 0, 0);\n"),
        ("(.05, .2, 1);\n}\n{", "(.05, .2, 1);\n)\n{"),
        ("color (1, .9, 6)", "color (1, .9, .6)"),
        ("halfframe plus", "halfframeplus"),
        ("shade, yabs, zabs, ymd, zmod", "shade, yabs, zabs, ymod, zmod"),
        ("(windowwid*order);", "(windowwid*order))"),
        # The language before solar(): P was the lit point, L and Cl were set in the open.
        ('transform( "world", P)', 'transform( "world", Ps)'),
        ("L = to - from;", "solar(to - from, 0)"),
    ],
    "threads": [
        ("phase = 0,0,", "phase = 0.0,"),
        ("offset = 0,0;", "offset = 0.0;"),
        ("(1.0 - v) / .05\n", "(1.0 - v) / .05;\n"),
        ("claculatenormal", "calculatenormal"),
    ],
    "filament": [],
}


def article(name):
    """The listing that begins with a shader kind on its line and `name` on the next."""
    text = next(SEEDS.glob("002_*.txt")).read_text()
    start = re.search(rf"^ *(surface|light|displacement) *\n *{name}\b", text, re.M).start()
    lines, depth, begun = [], 0, False
    for line in text[start:].splitlines():
        lines.append(line)
        bare = re.sub(r"/\*.*?\*/", "", line)
        depth += bare.count("{") - bare.count("}")
        # The window's printed parameter list is in braces of its own, closed by a line "}".
        begun = begun or (bare.strip() == "{") or bare.rstrip().endswith(") {") or name == "marble"
        if begun and depth == 0 and "}" in bare:
            return "\n".join(lines) + "\n"
    raise ValueError(name)


def mended(name):
    code = article(name)
    for wrong, right in MISPRINTS[name]:
        if wrong not in code:
            raise ValueError(f"{name}: no {wrong!r}")
        code = code.replace(wrong, right)
    return code


@unittest.skipUnless(SEEDS.is_dir(), "no ../shared/seeds")
class Seeds(ProgramTest):
    def shot(self, name, dae, *words):
        """Rows of grey values 0..255 of the scene's picture."""
        scene = self.folder / f"{name}.dae"
        dae.write(scene)
        out = scene.with_suffix(".png")
        self.expect(render(scene, "-o", out, "--size", "160x160", "--spp", "9", "--background",
                           "0,0,0.5", *words), 0)
        if os.environ.get("KINORA_KEEP"):
            shutil.copy(out, Path(os.environ["KINORA_KEEP"]) / f"seed_{name}.png")
        width, _, rows = png.read(out)
        return [[row[3 * x] for x in range(width)] for row in rows]

    def checked(self, name):
        code = mended(name)
        self.expect(shade("check", self.write(f"{name}.sl", code)), 0, "0 errors")
        return code

    def scene(self, eye=(0, -4.2, 1.2), to=(0, 0, 0), lit=True):
        dae = Dae()
        dae.camera("camera", 34, 1, [("lookat", "view", (*eye, *to, 0, 0, 1))])
        if lit:
            for name in ("distantlight", "ambientlight"):
                code = (SOURCE / f"assets/shaders/{name}.sl").read_text()
                dae.light(name, name, code, {"intensity": 0.9 if "dist" in name else 0.15})
                dae.light_node(name, [("lookat", "aim", (-2, -3, 3, 0, 0, 0, 0, 0, 1))])
        return dae

    def test_the_misprints_are_errors_before_they_are_mended(self):
        for name in ("windowlight", "threads"):
            self.expect(shade("check", self.write("as_printed.sl", article(name))), 4, "error")

    def test_marble_has_veins(self):
        dae = self.scene()
        dae.material("stone", [("SURFACE", "marble", self.checked("marble"))], {"Kd": 0.9})
        dae.mesh("ball", ball(), "stone")
        dae.node("ball", "ball", "stone")
        rows = self.shot("marble", dae)
        middle = [v for row in rows[50:110] for v in row[50:110]]
        self.assertGreater(sum(v > 150 for v in middle), len(middle) / 8)
        self.assertGreater(sum(v < 60 for v in middle), len(middle) / 50)

    def test_windowlight_throws_panes(self):
        dae = self.scene(eye=(3.2, -4.6, 1.4), to=(-2, -0.6, 0.5), lit=False)
        dae.light("sun", "windowlight", self.checked("windowlight"),
                  {"from": Point((3, 1, -1)), "to": Point((0, 0, 0))})
        dae.light_node("sun")
        matte = (SOURCE / "assets/shaders/matte.sl").read_text()
        dae.material("paper", [("SURFACE", "matte", matte)], {})
        dae.mesh("floor", grid_of(lambda s, t: (-2, 4 - 8 * s, 4 * t - 2.5), 1, 1), "paper")
        dae.node("floor", "floor", "paper")
        add_box(dae, "box", "paper", (-1.4, -1.6, 0), (-0.8, -1.0, 0.6))
        rows = self.shot("windowlight", dae, "--shadows", "off")
        # Red of the light's colour is 1 in a pane and 0.05 in the frame: borders on one line.
        best = max(sum((a < 110) != (b < 110) for a, b in zip(row, row[1:])) for row in rows)
        self.assertGreaterEqual(best, 7)

    def test_threads_wind_around_a_cylinder(self):
        plastic = (SOURCE / "assets/shaders/plastic.sl").read_text()
        pictures = []
        for amplitude in (0.0, 0.06):
            dae = self.scene()
            dae.material("brass", [("DISPLACEMENT", "threads", self.checked("threads")),
                                   ("SURFACE", "plastic", plastic)], {"amplitude": amplitude})
            dae.mesh("rod", lathe_of(lambda t: (0.7, 2 * t - 1), 96, 64), "brass")
            dae.node("rod", "rod", "brass")
            pictures.append(self.shot(f"threads{amplitude}", dae))

        def extrema(rows):
            column = [row[70] for row in rows[35:125]]
            slopes = [b - a for a, b in zip(column, column[1:]) if abs(b - a) > 2]
            return sum((a > 0) != (b > 0) for a, b in zip(slopes, slopes[1:]))

        self.assertLess(extrema(pictures[0]), 4)
        self.assertGreaterEqual(extrema(pictures[1]), 7)  # five threads: bright and dark by turns

    def test_filament_is_a_spiral_one_sees_through(self):
        dae = self.scene()
        dae.material("wire", [("SURFACE", "filament", self.checked("filament"))], {})
        dae.mesh("coil", lathe_of(lambda t: (0.6, 2 * t - 1), 96, 32), "wire")
        dae.node("coil", "coil", "wire")
        rows = self.shot("filament", dae)
        middle = [v for row in rows[45:115] for v in row[66:94]]
        # 0.3 of each wall is wire: seen through both walls about 1 - 0.7 * 0.7 is.
        self.assertAlmostEqual(sum(v > 128 for v in middle) / len(middle), 0.51, delta=0.12)

    def test_matte_of_the_appendix_renders_as_printed(self):
        text = next(SEEDS.glob("003_*.txt")).read_text()
        listing = re.search(r"```\s*\n<?(library_effects>.*?)```", text, re.S).group(1)
        # Lost in the print: the first "<", and line breaks that became elements.
        effect = ("<" + listing).replace("<br/>", "")
        self.assertIn('<effect id="Matte">', effect)
        dae = self.scene()
        dae.parts["effects"].append(re.sub(r"</?library_effects>", "", effect))
        dae.parts["materials"].append('<material id="m-material"><instance_effect url="#Matte"/>'
                                      "</material>")
        dae.mesh("ball", ball(), "m")
        dae.node("ball", "ball", "m")
        rows = self.shot("matte", dae)
        self.assertGreater(rows[60][60], rows[100][110] + 40)  # lit from the upper left
        self.assertLess(rows[3][3], 10)


if __name__ == "__main__":
    main()
