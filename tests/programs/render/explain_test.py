"""tests/programs/render/explain_test.py: kinora-render --explain, by switching each cause off."""
import json
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from programs import SCENES, ProgramTest, main, render
from written_scenes import (CAMERA, EYE, WHITE, animation, animations, document, geometries, place, rsl,
                            square)

NOISE = "surface s() { Oi = 1; Ci = noise(P); }"
FILTERED = "surface s() { Oi = 1; Ci = filterstep(0.5, s); }"
CUT = "surface s() { Oi = step(0.5, s); Ci = Oi; }"
LIGHT = ('<library_lights><light id="sun"><technique_common><{0}><color>1 1 1</color></{0}></technique_common></light>'
         '</library_lights>', '<node id="sun-node"><instance_light url="#sun"/></node>')


class Explain(ProgramTest):
    def explained(self, scene, *words):
        """Section -> rows."""
        return json.loads(self.expect(render(scene, "--explain=json", "-q", *words), 0).out)

    def written(self, look=WHITE, more="", nodes="", node=None):
        text = document(CAMERA + look + geometries(square()) + more, EYE + (node or place()) + nodes)
        return self.write("s.dae", text)

    def row(self, rows, section, text):
        """The rows of a section whose words hold the text."""
        return [r for r in rows.get(section, []) if text in f"{r['subject']}: {r['what']}; {r['why']}"]

    def test_derivatives_and_opacity_are_told_by_the_kernels(self):
        plain = self.explained(self.written(rsl(NOISE)))
        self.assertFalse(self.row(plain, "shaders", "no derivatives")[0]["modelled"])
        self.assertFalse(self.row(plain, "shaders", "no kernel for shadow rays")[0]["modelled"])
        filtered = self.explained(self.written(rsl(FILTERED)))
        self.assertTrue(self.row(filtered, "shaders", "derivatives of s")[0]["modelled"])
        cut = self.explained(self.written(rsl(CUT)))
        self.assertTrue(self.row(cut, "shaders", "a kernel of its own for shadow rays")[0]["modelled"])

    def test_globals_are_those_that_a_kernel_reads(self):
        for code, read in ((NOISE, "P"), (FILTERED, "s")):
            rows = self.explained(self.written(rsl(code)))
            what = self.row(rows, "shaders", "computed at each point")[0]["what"]
            self.assertIn(read, what.split(": ")[1].split())
            self.assertNotIn("N", what.split(": ")[1].split())

    def test_meshes_stand_or_move(self):
        standing = self.explained(self.written())
        self.assertFalse(self.row(standing, "meshes", "stands")[0]["modelled"])
        self.assertEqual(self.row(standing, "animation", "evaluated each frame"), [])
        channel = animations(animation("a", "node/t.X", [0, 1], [0, 1]))
        moving = self.explained(self.written(more=channel, node=place('<translate sid="t">0 0 0</translate>')))
        self.assertTrue(self.row(moving, "meshes", "moves")[0]["modelled"])
        self.assertEqual(self.row(moving, "animation", "evaluated each frame")[0]["subject"], "1 channels")

    def test_lights_are_told_with_what_they_do_not_need(self):
        for kind, shadows in (("directional", True), ("ambient", False)):
            libraries, node = LIGHT[0].format(kind), LIGHT[1]
            rows = self.explained(self.written(rsl("surface s() { Oi = 1; Ci = diffuse(N) + ambient(); }"), libraries, node),
                                  "--lights", "scene")
            self.assertEqual(bool(self.row(rows, "lights", "no shadow rays")), not shadows, rows["lights"])
        off = self.explained(self.folder / "s.dae", "--lights", "scene", "--shadows", "off")
        self.assertTrue(self.row(off, "lights", "sun"))

    def test_textures_are_those_that_were_opened(self):
        rows = self.explained(self.written(rsl(NOISE)))
        self.assertFalse(self.row(rows, "textures", "none is opened")[0]["modelled"])
        self.assertFalse(self.row(rows, "textures", "OpenImageIO")[0]["modelled"])

    def test_settings_name_who_set_them(self):
        rows = self.explained(self.written(), "--quality", "draft", "--spp", "9")
        self.assertEqual(self.row(rows, "settings", "spp")[0]["why"], "--spp")
        self.assertEqual(self.row(rows, "settings", "math")[0]["why"], "--quality draft")

    def test_text_says_the_same_in_lines(self):
        out = self.expect(render(SCENES / "walker.dae", "--explain", "-q"), 0).out
        for section in ("settings", "meshes", "animation", "shaders", "lights"):
            self.assertRegex(out, rf"(?m)^{section}$")
        self.assertRegex(out, r"(?m)^  \+ .*: deforms")
        self.assertRegex(out, r"(?m)^  - .*: stands")

    def test_it_needs_no_picture_and_may_have_one(self):
        self.expect(render(self.written(), "-o", self.folder / "a.png", "--size", "8x8", "--explain", "-q"), 0, "settings")
        self.assertTrue((self.folder / "a.png").exists())


if __name__ == "__main__":
    main()
