"""tests/programs/newcomer_test.py: what people type who have not read the pages: names in capitals, forgotten and misplaced
words, files that are none. Each answer says what is wrong."""
import sys

from programs import MATTE, SOURCE, ProgramTest, main, render, run, shade

sys.path[:0] = [str(SOURCE / "tests/conformance")]
import dae  # noqa: E402

SMALL = ("--size", "8x8", "--spp", "1", "--progress", "none")
FACING = "surface facing(output varying float edge = 0;) { edge = 1; Oi = 1; Ci = 0.5; }"


class Newcomer(ProgramTest):
    def picture(self, name):
        return self.folder / name

    def test_a_missing_scene_is_told_before_a_missing_output(self):
        self.expect(render("nosuch.dae"), 3, "error:", "'nosuch.dae'", "no such file")
        self.expect(render(self.folder), 3, "error:", "folder")
        self.expect(render(MATTE), 2, "-o FILE")
        self.expect(render(), 2, "scene")

    def test_extensions_may_have_capitals(self):
        scene = self.write("A.DAE", dae.plain())
        self.expect(render(scene, "-o", self.picture("a.PNG"), *SMALL), 0)
        self.expect(render(scene, "-o", self.picture("b.png"), *SMALL), 0)
        self.assertEqual(self.picture("a.PNG").read_bytes(), self.picture("b.png").read_bytes())
        surface = self.write("FACING.SL", FACING)
        self.expect(render(scene, "-o", self.picture("a.EXR"), "--shader", f"*={surface}", "--aov", "edge", *SMALL), 0)
        self.assertEqual(self.picture("a.EXR").read_bytes()[:4], b"\x76\x2f\x31\x01")
        for name, magic in (("x.DAE", b"<?xml"), ("x.GLB", b"glTF"), ("x.GLTF", b"{"), ("x.Dae", b"<?xml")):
            out = self.picture(name)
            self.expect(run("kinora-convert", scene, out, "--shader", f"mat={surface}"), 0)
            self.assertEqual(out.read_bytes()[:len(magic)], magic)
            self.expect(render(out, "-o", self.picture("c.png"), *SMALL), 0)
        self.expect(shade("check", surface), 0)
        self.expect(shade("check", f"{self.picture('x.DAE')}#fx"), 0)
        self.expect(run("kinora-validate", "-r", self.folder), 0, "3 files")

    def test_the_output_of_a_conversion_may_stand_behind_o(self):
        for words in (("-o", self.picture("a.glb")), ("--output", self.picture("b.glb"))):
            self.expect(run("kinora-convert", MATTE, *words), 0)
            self.assertTrue(words[1].exists())
        self.expect(run("kinora-convert", MATTE), 2, "output")

    def test_a_value_is_not_the_next_option(self):
        for words in (("--contact-sheet", "--frames", "1-4"), ("--turntable", "-o", "f.####.png"), ("--size", "--spp", "4")):
            result = self.expect(render(MATTE, *words), 2, words[0])
            if words[1].startswith("--"):
                self.assertIn(f"{words[0]}: needs a value; '{words[1]}' is an option", result.err)
        self.expect(render(MATTE, "-o", "null", "--look-from", "-3,-4,2", *SMALL), 0)

    def test_a_contact_sheet_is_a_png(self):
        self.expect(render(MATTE, "--contact-sheet", self.picture("s.jpg"), *SMALL), 2, "--contact-sheet", ".png")
        self.assertFalse(self.picture("s.jpg").exists())

    def test_what_is_missing_is_an_error_under_strict(self):
        scene = self.write("a.dae", dae.textured())
        out = self.picture("a.png")
        for words in ((), ("-q",)):
            result = self.expect(render(scene, "-o", out, "--strict", *SMALL, *words), 5, "error: file 'map.png'")
            self.assertNotIn("warning: file", result.err)
            self.expect(run("kinora-convert", scene, self.picture("a.glb"), "--strict", *words), 5, "error: file 'map.png'")
        self.assertFalse(out.exists())
        self.expect(render(scene, "-o", out, *SMALL), 0, "warning: file 'map.png'")

    def test_a_file_that_is_no_scene_is_an_error_at_its_place(self):
        for name, text in (("a.dae", "hello\n"), ("b.dae", "surface a() { Ci = 1; }\n")):
            result = self.expect(render(self.write(name, text), "-o", self.picture("a.png")), 3, f"{name}:1:1: error:")
            self.assertNotIn("warning:", result.err)

    def test_an_empty_list_says_so(self):
        self.expect(render(MATTE, "--lights", "scene", "--list", "lights"), 0, "no lights")
        self.expect(render(MATTE, "-o", self.picture("a.exr"), "--aov", "glow", *SMALL), 2, "'glow'", "output varying")

    def test_what_a_conversion_could_not_read_is_lost(self):
        scene = self.write("a.dae", dae.textured())
        self.expect(run("kinora-convert", scene, self.picture("a.glb")), 0, "image 'map.png': lost: no such file")

    def test_commands_are_named(self):
        self.expect(shade(), 2, "needs a command: check, info, run")


if __name__ == "__main__":
    main()
