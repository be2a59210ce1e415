"""tests/programs/findings_test.py: what the programs say of a scene, how often, and what they exit with:
"error:" never stands beside exit 0, and a picture's user hears what spoils the picture."""
import os
import re
import sys

from programs import SCENES, SHADERS, SOURCE, TEST_DATA, ProgramTest, main, render, run, shade

sys.path[:0] = [str(SOURCE / "tests/conformance")]
import dae  # noqa: E402

SMALL = ("--size", "4x4", "--spp", "1", "--threads", "1", "--time", "0", "--quality", "draft")
CODE = re.compile(r"(error|warning|info|hint): .*\[([A-Z0-9_]+)\]$", re.M)


def said(result):
    """Severity and code of each finding on stderr."""
    return CODE.findall(result.err)


def unbound(count):
    """As many primitives whose symbols nothing binds, after one that is bound."""
    more = "".join(dae.triangles().replace('material="m"', f'material="gone{i}"') for i in range(count))
    return dae.document(dae.node(), geometries=dae.geometry(dae.triangles() + more))


def dangling(count):
    """As many instances of geometries that are not there, behind one that is."""
    return dae.document(dae.node() + "".join(
        f'<node><instance_geometry url="#gone{i}"/></node>' for i in range(count)))


class FindingsTest(ProgramTest):
    def setUp(self):
        super().setUp()
        self.out = self.folder / "o.png"

    def render(self, scene, *words):
        self.out.unlink(missing_ok=True)
        return render(scene, "-o", self.out, *SMALL, *words)


class Errors(FindingsTest):
    def check(self, result, scene):
        errors = [code for severity, code in said(result) if severity == "error"]
        if result.code == 0:
            self.assertEqual(errors, [], (scene, result))
            self.assertNotIn("error:", result.err, (scene, result))
        else:
            self.assertIn("error:", result.err, (scene, result))

    def test_an_error_is_never_beside_exit_0(self):
        """Over the documents that cause each code that the validator calls an error, and more."""
        rules = sorted((TEST_DATA / "rules").glob("*.dae"))
        self.assertGreater(len(rules), 300)
        wrong = re.compile(r"^(XML|DOC|LINK|SRC|PRIM|SKIN|MORPH|RSL|SCENE|NODE|CAM)_[A-Z_]+\.dae$")
        chosen = [path for path in rules if wrong.match(path.name)]
        self.assertGreater(len(chosen), 60)
        pictures = 0
        for scene in chosen:
            with self.subTest(scene=scene.name):
                result = self.render(scene)
                self.check(result, scene)
                self.assertEqual(result.code == 0, self.out.exists())
                pictures += result.code == 0
                self.check(run("kinora-convert", scene, self.folder / "o.glb"), scene)
        self.assertGreater(pictures, 40)

    def test_an_index_is_shown_as_it_is_written(self):
        for written in ("4294967295", "99999999999999999999", "-3", "-99999999999999999999"):
            scene = self.write("a.dae", dae.plain().replace("<p>", f"<p>{written} 0 0 ", 1))
            self.expect(self.render(scene), 0, f"index {written} is")

    def test_what_is_left_out_is_a_warning_and_an_error_for_the_validator_and_strict(self):
        text = dae.plain().replace("<p>", "<p>99999 0 0 ", 1)
        self.assertIn("99999", text)
        scene = self.write("a.dae", text)
        result = self.expect(self.render(scene), 0)
        self.assertIn(("warning", "PRIM_INDEX_RANGE"), said(result))
        self.assertTrue(self.out.exists())
        result = self.expect(self.render(scene, "--strict"), 1)
        self.assertIn(("error", "PRIM_INDEX_RANGE"), said(result))
        self.assertFalse(self.out.exists())
        self.expect(run("kinora-convert", scene, self.folder / "o.glb"), 0, "warning:")
        self.assertTrue((self.folder / "o.glb").exists())
        self.expect(run("kinora-convert", "--strict", scene, self.folder / "p.glb"), 1, "error:")
        self.assertFalse((self.folder / "p.glb").exists())
        self.expect(run("kinora-validate", scene), 1, "error:")

    def test_a_scene_that_ends_early_is_shown_as_far_as_it_goes(self):
        text = (SCENES / "matte.dae").read_text()
        scene = self.write("cut.dae", text[:text.index("</library_geometries>")])
        result = self.render(scene)
        self.check(result, scene)
        self.expect(run("kinora-convert", scene, self.folder / "o.dae"), 3, "error:")

    def test_broken_parts_of_gltf_are_warnings(self):
        out = self.folder / "m.gltf"
        self.expect(run("kinora-convert", SCENES / "matte.dae", out), 0)
        text = re.sub(r'"POSITION": \d+', '"POSITION": 999', out.read_text(), count=1)
        scene = self.write("n.gltf", text)
        result = self.render(scene)
        self.check(result, scene)
        self.assertIn(("warning", "GLTF_REFERENCE"), said(result))


class Exits(FindingsTest):
    def test_missing_files_are_exit_5_in_every_program(self):
        missing = self.write("scene/a.dae", dae.textured())
        refused = self.write("scene/b.dae", dae.textured(path="../outside.png"))
        (self.folder / "outside.png").write_bytes(dae.png(dae.picture()))
        for words in ((missing,), (refused, "--confine")):
            self.expect(self.render(*words), 0)
            self.expect(self.render(*words, "--strict"), 5)
            self.assertFalse(self.out.exists())
            out = self.folder / "o.glb"
            self.expect(run("kinora-convert", *words, out), 0)
            out.unlink()
            self.expect(run("kinora-convert", "--strict", *words, out), 5)
            self.assertFalse(out.exists())
            plain = run("kinora-validate", *words)
            self.assertEqual(plain.code, 1 if "--confine" in words else 0, plain)
            self.expect(run("kinora-validate", "--strict", "--only", "FILE_,LINK_", *words), 5)
        self.expect(self.render(refused, "--strict"), 0)
        wrong = self.write("scene/c.dae", dae.textured().replace("<p>", "<p>99999 0 0 ", 1))
        self.expect(run("kinora-validate", "--strict", "--only", "FILE_,PRIM_", wrong), 1)
        source = self.write("t.sl", 'surface t() { Oi = 1; Ci = texture("none.png", s, t); }')
        self.expect(shade("run", source, "--size", "4x4"), 0, "IMAGE_UNREADABLE")
        self.expect(shade("run", source, "--size", "4x4", "--strict"), 5, "IMAGE_UNREADABLE")

    def test_fail_on_warning_fails_behind_the_work(self):
        scene = self.write("a.dae", dae.textured())
        self.expect(self.render(scene, "--fail-on", "error"), 0)
        self.expect(self.render(scene, "--fail-on", "warning"), 1, "FILE_MISSING")
        self.assertTrue(self.out.exists())
        shot = self.folder / "shot.png"
        headless = ("kinora-play", scene, "--headless", "--size", "8x8", "--screenshot", shot, "--fail-on")
        self.expect(run(*headless, "error"), 0)
        self.expect(run(*headless, "warning"), 1, "FILE_MISSING")
        self.assertTrue(shot.exists())
        (self.folder / "map.png").write_bytes(dae.png(dae.picture()))
        self.expect(self.render(scene, "--fail-on", "warning"), 0)
        out = self.folder / "o.dae"
        lost = self.write("b.dae", unbound(1))
        self.expect(run("kinora-convert", "--fail-on", "warning", lost, self.folder / "o.glb"), 1)
        self.assertTrue((self.folder / "o.glb").exists())
        self.expect(run("kinora-convert", "--fail-on", "warning", scene, out), 0)
        self.expect(run("kinora-validate", "--fail-on", "warning", "--only", "MAT_", lost), 1)
        source = self.write("w.sl", "surface w() { Oi = 1; Ci = 1; 2 + 3; }")
        self.expect(shade("check", source), 0, "RSL_NO_EFFECT")
        self.expect(shade("check", "--fail-on", "warning", source), 4)
        for program in ("kinora-render", "kinora-convert"):
            self.expect(run(program, scene, "--fail-on", "often"), 2, "often")

    def test_aovs_are_checked_before_rendering(self):
        scene = SCENES / "matte.dae"
        self.expect(self.render(scene, "--aov", "albedo"), 2, "--aov", ".exr")
        self.assertFalse(self.out.exists())
        self.expect(render(scene, "--contact-sheet", self.out, *SMALL, "--aov", "albedo"), 2, ".exr")
        exr = self.folder / "o.exr"
        result = self.expect(render(scene, "-o", exr, *SMALL, "--aov", "nothing_of_that_name"), 2)
        self.assertEqual([code for severity, code in said(result) if severity == "error"], ["AOV_UNKNOWN"])
        self.assertFalse(exr.exists())
        given = self.write("a.sl", "surface a(output varying float depth = 0;) { depth = 2; Oi = 1; Ci = 1; }")
        self.expect(render(scene, "-o", exr, *SMALL, "--aov", "depth", "--shader", f"*={given}"), 0)


class Words(FindingsTest):
    def lines(self, result, code):
        return sum(c == code for _, c in said(result))

    def test_at_most_20_lines_then_how_many(self):
        scene = self.write("a.dae", dangling(1000))
        shot = self.folder / "shot.png"
        runs = (("kinora-render", scene, "-o", self.out, *SMALL, "--progress", "none"),
                ("kinora-convert", scene, self.folder / "o.glb"),
                ("kinora-play", scene, "--headless", "--size", "8x8", "--screenshot", shot))
        for words in runs:
            result = self.expect(run(*words), 0, "more of LINK_UNRESOLVED", "; -v shows all")
            shown = self.lines(result, "LINK_UNRESOLVED")
            self.assertGreaterEqual(shown, 2)
            self.assertIn(f"{1000 - shown} more of LINK_UNRESOLVED", result.err)
            self.assertLessEqual(result.err.count("\n"), 20, words)

    def test_the_most_serious_findings_come_first_and_each_code_is_seen(self):
        """A thousand warnings of one code do not hide one of another, and no error."""
        text = dangling(1000).replace("<p>", "<p>99999 0 0 ", 1)
        scene = self.write("a.dae", text)
        result = self.expect(self.render(scene, "--progress", "none"), 0, "more of LINK_UNRESOLVED")
        self.assertEqual(self.lines(result, "PRIM_INDEX_RANGE"), 1)
        self.assertLessEqual(result.err.count("\n"), 20)
        broken = self.write("t.sl", "surface t() { Oi = 1; Ci = nothing; }")
        result = self.expect(self.render(scene, "--shader", f"*={broken}"), 4)
        self.assertEqual(said(result)[0][0], "error", result.err)
        self.assertIn(("warning", "PRIM_INDEX_RANGE"), said(result))
        self.assertLessEqual(result.err.count("\n"), 20)

    def test_all_findings_are_told_when_they_are_asked_for(self):
        scene = self.write("a.dae", dangling(57))
        result = self.expect(self.render(scene, "-v"), 0)
        self.assertEqual(self.lines(result, "LINK_UNRESOLVED"), 57)
        self.assertNotIn("more", result.err)
        result = self.expect(self.render(scene, "-q"), 0)
        self.assertEqual(result.err, "")
        few = self.write("b.dae", dangling(4))
        result = self.expect(self.render(few), 0)
        self.assertEqual(self.lines(result, "LINK_UNRESOLVED"), 4)
        self.assertNotIn("more of", result.err)

    def test_schema_names_and_style_are_one_line(self):
        text = dae.plain()
        for i in range(4):
            text = text.replace("</asset>", f"</asset><library_of_{i}/>", 1)
        text = text.replace('version="1.4.1"', 'version="1.4.7"').replace("2005/11", "2005/12")
        scene = self.write("a.dae", text)
        verbose = self.expect(self.render(scene, "-v"), 0)
        hidden = [code for severity, code in said(verbose) if severity == "info"]
        self.assertEqual(hidden.count("SCHEMA_UNKNOWN_ELEMENT"), 4)
        self.assertIn("DOC_VERSION", hidden)
        validated = run("kinora-validate", scene)
        warned = [code for severity, code in CODE.findall(validated.out) if severity in ("warning", "error")]
        count = sum(code in set(warned) for code in hidden)
        result = self.expect(self.render(scene), 0, f"{count} more: kinora-validate {scene}\n")
        self.assertEqual(said(result), [])
        self.assertEqual(result.err.count("\n"), 2, result.err)  # and the frame's line
        out = self.folder / "o.glb"
        self.expect(run("kinora-convert", scene, out), 0, f"{count} more: kinora-validate {scene}\n")

    def test_a_good_scene_is_silent(self):
        for scene in ("matte.dae", "court.dae"):
            result = self.expect(self.render(SCENES / scene, "--progress", "none"), 0)
            self.assertEqual(result.err, "")

    def test_a_picture_found_elsewhere_spoils_nothing(self):
        scene = self.write("scene/a.dae", dae.textured(path="C:/art/Map.png"))
        self.expect(self.render(scene), 0, "FILE_MISSING")
        os.makedirs(self.folder / "materials/textures")
        (self.folder / "materials/textures/map.png").write_bytes(dae.png(dae.picture()))
        result = self.expect(self.render(scene), 0, "2 more: kinora-validate")
        self.assertEqual(said(result), [])

    def test_each_finding_is_told_once_however_many_frames(self):
        source = self.write("p.sl", 'surface p() { Oi = 1; Ci = texture("none.png", 0.5, 0.5); }')
        frames = self.folder / "f.####.png"
        result = render(SCENES / "matte.dae", "-o", frames, "--size", "4x4", "--spp", "1", "--frames", "0-5",
                        "--shader", f"*={source}")
        self.expect(result, 0)
        self.assertEqual(self.lines(result, "IMAGE_UNREADABLE"), 1)

    def test_the_validator_lists_both_severities(self):
        rules = run("kinora-validate", "--explain", "PRIM_INDEX_RANGE").out
        self.assertIn("PRIM_INDEX_RANGE (error; warning when rendering)", rules)
        self.assertIn("SCHEMA_ORDER (warning; info when rendering)", run("kinora-validate", "--explain",
                                                                         "SCHEMA_ORDER").out)
        self.assertIn("XML_OPEN (error)", run("kinora-validate", "--explain", "XML_OPEN").out)


if __name__ == "__main__":
    main()
