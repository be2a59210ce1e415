"""tests/programs/validate_test.py: kinora-validate as its users run it."""
import json

from programs import BIN, MATTE, SCENES, ProgramTest, main, run

HEAD = ('<?xml version="1.0" encoding="utf-8"?>\n<COLLADA xmlns="http://www.collada.org/2005/11/'
        'COLLADASchema" version="1.4.1">\n<asset><created>2020-01-01T00:00:00Z</created>'
        '<modified>2020-01-01T00:00:00Z</modified></asset>\n')
# A scene that is valid and has nothing in it.
EMPTY = HEAD + ('<library_visual_scenes><visual_scene id="v"><node id="n"/></visual_scene>'
                '</library_visual_scenes>\n<scene><instance_visual_scene url="#v"/></scene>\n'
                '</COLLADA>\n')


def validate(*words, **options):
    return run("kinora-validate", *words, **options)


def findings(*words, **options):
    """The findings of the first file, from JSON."""
    return json.loads(validate("--format", "json", *words, **options).out)["files"][0]["findings"]


def codes(*words, **options):
    return [f["code"] for f in findings(*words, **options)]


class Findings(ProgramTest):
    def test_our_own_scenes_are_clean(self):
        files = sorted(SCENES.glob("**/*.dae"))
        result = validate(*files)
        self.expect(result, 0, f"{len(files)} files: ")
        self.assertNotIn("error", result.out)
        self.assertNotIn("warning", result.out)

    def test_a_finding_has_place_code_path_and_caret(self):
        scene = self.write("s.dae", EMPTY.replace('url="#v"', 'url="#w"'))
        result = validate(scene)
        self.expect(result, 0, "s.dae:5:36: warning: ", "[LINK_UNRESOLVED]",
                    "in scene/instance_visual_scene", " ^~\n")

    def test_errors_of_embedded_shaders_have_the_document_s_place(self):
        text = MATTE.read_text().replace("diffuse(", "difuse(")
        scene = self.write("s.dae", text)
        line, row = next((i, r) for i, r in enumerate(text.splitlines(), 1) if "difuse(" in r)
        result = validate(scene)
        self.expect(result, 1, f"s.dae:{line}:{row.index('difuse(') + 1}: error: ",
                    "library_effects/effect[@id='Matte']/profile_RSL", "did you mean 'diffuse'")

    def test_binds_that_fit_no_parameter(self):
        text = MATTE.read_text()
        self.assertIn('symbol="', text)
        wrong = text.replace('symbol="', 'symbol="x', 1)
        self.assertIn("RSL_BIND_UNKNOWN", codes(self.write("s.dae", wrong)))

    def test_exit_codes(self):
        good = self.write("good.dae", EMPTY)
        broken = self.write("broken.dae", EMPTY[:-12])
        self.expect(validate(good), 0, "1 file: nothing")
        self.expect(validate(broken), 1, "XML_SYNTAX")
        self.expect(validate(self.folder / "none.dae"), 3, "XML_OPEN")
        self.expect(validate(self.folder), 3, "-r")
        self.assertEqual(validate().code, 2)
        self.assertEqual(validate("--format", "yaml", good).code, 2)
        self.assertEqual(validate(good, broken, self.folder / "none.dae").code, 3)

    def test_stdin_and_directories(self):
        self.expect(validate("-", stdin=EMPTY[:-12]), 1, "<stdin>:")
        for name in ("b/x.dae", "a/y.DAE", "a/c/z.dae", "a/text.txt"):
            (self.folder / name).parent.mkdir(parents=True, exist_ok=True)
            self.write(name, EMPTY)
        names = [f["file"] for f in json.loads(
            validate("-r", self.folder, "--format", "json").out)["files"]]
        self.assertEqual([n[len(str(self.folder)) + 1:] for n in names],
                         ["a/c/z.dae", "a/y.DAE", "b/x.dae"])


class Options(ProgramTest):
    def setUp(self):
        super().setUp()
        self.scene = self.write("s.dae", EMPTY.replace('url="#v"', 'url="#w"'))

    def test_severities_and_what_fails(self):
        self.assertEqual(validate(self.scene).code, 0)
        self.assertEqual(validate(self.scene, "--fail-on", "warning").code, 1)
        self.assertEqual(validate(self.scene, "--severity", "LINK_UNRESOLVED=error").code, 1)
        self.assertEqual(validate(self.scene, "--profile", "strict").code, 1)
        off = validate(self.scene, "--severity", "LINK_*=off")
        self.assertNotIn("LINK_UNRESOLVED", off.out)
        self.expect(validate(self.scene, "--severity", "LINK_UNRESOLVD=off"), 2,
                    "did you mean LINK_UNRESOLVED")

    def test_only_and_max_issues(self):
        self.assertTrue(all(c.startswith("LINK_") for c in codes(self.scene, "--only", "LINK_")))
        self.assertNotIn("LINK_UNRESOLVED", codes(self.scene, "--only", "XML_,DOC_"))
        self.assertEqual(len(codes(self.scene, "--max-issues", "1")), 1)

    def test_every_code_is_explained(self):
        rules = json.loads(validate("--list-rules", "--format", "json").out)
        self.assertGreater(len(rules), 150)
        for rule in rules[::10]:
            self.expect(validate("--explain", rule["code"]), 0, rule["code"], rule["severity"])
        every = validate("--explain", "all").out
        for rule in rules:
            self.assertIn(rule["code"] + " (", every)
        self.expect(validate("--explain", "NODE_SINGLAR"), 2)

    def test_any_number_of_threads_gives_the_same_bytes(self):
        files = sorted(SCENES.glob("**/*.dae")) * 20 + [self.scene]
        for report in ("text", "json", "sarif", "junit", "html"):
            one = validate(*files, "-j", "1", "--format", report).out
            self.assertEqual(one, validate(*files, "-j", "4", "--format", report).out)

    def test_program_is_there(self):
        self.assertTrue((BIN / "kinora-validate").exists())


if __name__ == "__main__":
    main()
