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


# The class listings of the transcription by their first and last lines, the file that completes
# them, and what stands there in place of what the transcription has.
CLASSES = SOURCE / "tests/rsl/classes"
CLASS_LISTINGS = [
    ("class rslTwoShader(", "public void userCreatedFunc() {", "seed_two_shader",
     [("class rslTwoShader( shader params ) {", "class rslTwoShader(")]),
    ("public void generateSamples(", "samples[i]->setMaterialSamples(", "seed_material",
     [('if(distribution == "specular") {', 'if(distribution == "specular" || '),
      ("color materialresponse = 0;", "color matresp = 0;"), ("float materialpdf = 0;", "float matpdf = 0;"),
      # An asterisk too many, and both divisors in one; the response has the cosine.
      ("matresp = refl * (F*G*D*)/4*(Vn.Nn)*(Ln.Nn);", "matresp = refl * (F*G*D)/(4*(Vn.Nn)*(Ln.Nn)) * (Ln.Nn);")]),
    ("float evaluateSamples(", "samples[i]->setMaterialResponse(matresp, 0);", "seed_material",
     [("float evaluateSamples(string distribution;", "public void evaluateSamples(string distribution;")]),
    ("public void lighting(output color Ci, Oi) {", "Ci += (Kd", "seed_material",
     [('"mis" 1,', '"mis", 1,'), ("indirectdiffuse(P, Nn,", "indirectdiffuse(P, m_shadingCtx->m_Ns,"),
      ("(1-fresnel)", "(1-m_fres->m_Kr)"), ("spec_color", "spec_col")]),
]


def class_lines(first, last, mended):
    """Code lines of a listing without comments and spaces, mended."""
    text = next(SEEDS.glob("004_*.txt")).read_text() + "\n"
    end = text.index("\n", text.index(last, text.index(first)))
    listing = text[text.index(first):end]
    for wrong, right in mended:
        if wrong not in listing:
            raise ValueError(f"no {wrong!r}")
        listing = listing.replace(wrong, right)
    bare = re.sub(r"/\*.*?\*/|//[^\n]*", "", listing, flags=re.S)
    return [line for line in ("".join(line.split()) for line in bare.splitlines()) if line]


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
    def shot(self, name, dae, *words, spp=9):
        """Rows of grey values 0..255 of the scene's picture."""
        scene = self.folder / f"{name}.dae"
        dae.write(scene)
        out = scene.with_suffix(".png")
        self.expect(render(scene, "-o", out, "--size", "160x160", "--spp", str(spp), "--background",
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

    def test_each_line_of_the_classes_stands_in_what_completes_them(self):
        count = 0
        for first, last, file, mended in CLASS_LISTINGS:
            complete = "".join((CLASSES / f"{file}.sl").read_text().split())
            for line in class_lines(first, last, mended):
                count += 1
                self.assertIn(line, complete, file)
        self.assertGreater(count, 35)

    def class_scene(self, name, floor=True):
        code = (CLASSES / f"{name}.sl").read_text()
        shader = re.search(r"^class (\w+)", code, re.M)[1]
        self.expect(shade("check", self.write(f"{name}.sl", code)), 0, "0 errors")
        dae = self.scene()
        few = {"num_samps": 4.0, "num_diffuse_samps": 4.0} if "num_samps" in code else {}
        dae.material("look", [("SURFACE", shader, code)], few)
        dae.mesh("ball", ball(), "look")
        dae.node("ball", "ball", "look")
        if floor:
            dae.material("paper", [("SURFACE", "matte", (SOURCE / "assets/shaders/matte.sl").read_text())], {"Kd": 0.25})
            dae.mesh("floor", grid_of(lambda s, t: (8 * s - 4, 8 * t - 4, -1), 1, 1), "paper")
            dae.node("floor", "floor", "paper")
        return dae, code

    def test_the_simple_class_is_a_pierced_shell(self):
        dae, code = self.class_scene("seed_two_shader", floor=False)
        rows = self.shot("class", dae)
        # Through holes in front and behind one sees the background, whose red is 0.
        middle = [v for row in rows[50:110] for v in row[50:110]]
        holes = sum(v == 0 for v in middle) / len(middle)
        self.assertGreater(holes, 0.01)
        self.assertLess(holes, 0.7)
        dae = self.class_scene("seed_two_shader", floor=False)[0]
        dae.parts["effects"] = [e.replace("Ci *= Oi;", "Ci *= 0;") for e in dae.parts["effects"]]
        self.assertLess(max(max(row) for row in self.shot("class_dark", dae)), 5)

    def test_the_material_shines_by_its_own_samples(self):
        rows = self.shot("material", self.class_scene("seed_material")[0], spp=2)

        def shown(x, y):
            return sum(v for row in rows[y - 6:y + 7] for v in row[x - 6:x + 7]) / 169

        self.assertGreater(shown(70, 70), shown(115, 70) + 20)  # lit from the upper left
        dae, code = self.class_scene("seed_material")
        dae.parts["effects"] = [e.replace("+ spec_col + indir_spec", "+ 0 * indir_spec")
                                for e in dae.parts["effects"]]
        matte = self.shot("material_matte", dae, spp=2)
        brighter = [a - b for row, other in zip(rows, matte) for a, b in zip(row, other)]
        self.assertGreater(max(brighter), 40)  # the highlight
        self.assertGreaterEqual(min(brighter), -12)  # noise of random() alone

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
