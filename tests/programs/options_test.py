"""tests/programs/options_test.py: what the command lines of all programs have in common."""
from programs import MATTE, SHADERS, ProgramTest, main, render, run, shade

SMALL = ("--size", "24x16", "--spp", "1", "--threads", "1", "--progress", "none")
PROGRAMS = ("kinora-render", "kinora-validate", "kinora-convert", "kinora-shade")


def validate(*words, **options):
    return run("kinora-validate", *words, **options)


def convert(*words, **options):
    return run("kinora-convert", *words, **options)


class Words(ProgramTest):
    def test_repeatable_options_take_one_word_and_leave_the_scene(self):
        out, dae = self.folder / "a.exr", self.folder / "a.dae"
        plastic = SHADERS / "plastic.sl"
        outputs = self.write("ab.sl", "surface ab(output float a = 0; output float b = 0;) { a = b; Ci = 1; }")
        rows = [
            (render, ("-I", self.folder, MATTE, "-o", out, *SMALL)),
            (render, ("--shader", f"*={outputs}", "--aov", "a,b", MATTE, "-o", out, *SMALL)),
            (render, ("--shader", f"dim={plastic}", MATTE, "-o", out, *SMALL)),
            (render, ("--param", "dim.Ka=0.5", MATTE, "-o", out, *SMALL)),
            (render, ("--hide", "left", MATTE, "-o", out, *SMALL)),
            (render, ("--only", "left", "--only", "right", MATTE, "-o", out, *SMALL)),
            (render, ("--allow-external", self.folder, MATTE, "-o", out, *SMALL)),
            (render, ("--dump", "ir", MATTE)),
            (convert, ("-I", self.folder, MATTE, dae)),
            (convert, ("--shader", f"dim={plastic}", MATTE, dae)),
            (convert, ("--allow-external", self.folder, MATTE, dae)),
            (validate, ("-I", self.folder, MATTE)),
            (validate, ("--only", "XML_", MATTE)),
            (validate, ("--severity", "XML_SYNTAX=error", MATTE)),
            (validate, ("--budget", "triangles=100", MATTE)),
            (shade, ("check", "-D", "A=1", "-U", "A", "-I", self.folder, plastic)),
            (shade, ("dump", "--stage", "ast,types", plastic)),
        ]
        for program, words in rows:
            with self.subTest(words=words):
                self.expect(program(*words), 0)

    def test_values_that_may_be_left_out_do_not_take_the_scene(self):
        out, dae = self.folder / "a.png", self.folder / "a.dae"
        self.expect(render("--stats", MATTE, "-o", out, *SMALL), 0, "peak memory")
        self.expect(render("--stats", "json", MATTE, "-o", out, *SMALL), 0, '"peak_memory_bytes"')
        self.expect(render("--stats=json", MATTE, "-o", out, *SMALL), 0, '"peak_memory_bytes"')
        self.expect(render("--list", MATTE, "-v"), 0, "camera", "material bright")
        self.expect(render("--list", "materials", MATTE), 0, "material bright")
        self.expect(validate("--stats", MATTE), 0)
        self.expect(convert("--stats", MATTE, dae), 0, "bytes in")
        self.expect(render(MATTE, "-o", out, "--stats=yes"), 2, "'yes' is none of text, json")

    def test_names_that_are_none_say_which_there_are(self):
        out = ("-o", self.folder / "a.png")
        rows = [
            (render, (MATTE, *out, "--up", "W"), "--up: 'W' is none of X, Y, Z"),
            (render, (MATTE, *out, "--transparency", "aut"), "did you mean auto?"),
            (render, (MATTE, *out, "--filter", "lanczos"), "box, triangle, gaussian"),
            (render, (MATTE, *out, "--quality", "fine"), "draft, preview, final, reference"),
            (render, (MATTE, *out, "--lights", "none"), "auto, scene, default, both"),
            (render, (MATTE, "--list", "camera"), "did you mean cameras?"),
            (render, (MATTE, *out, "--unit", "inch"), "--unit: 'inch' is no number"),
            (convert, (MATTE, "a.dae", "--up", "W"), "--up: 'W' is none of X, Y, Z"),
            (validate, (MATTE, "--format", "xml"), "text, json, sarif, junit, html"),
            (validate, (MATTE, "--profile", "1.6"), "1.4.1, 1.5"),
            (validate, (MATTE, "--fail-on", "never"), "hint, info, warning, error"),
            (validate, (MATTE, "--max-issues", "-1"), "--max-issues"),
            (validate, (MATTE, "--max-issues", "x"), "--max-issues"),
            (shade, ("run", SHADERS / "plastic.sl", "--math", "exact"), "precise, fast"),
        ]
        for program, words, text in rows:
            with self.subTest(words=words):
                self.expect(program(*words), 2, text)
        self.assertEqual(list(self.folder.iterdir()), [])

    def test_unknown_options_are_named_with_what_may_be_meant(self):
        rows = [
            (render, (MATTE, "--frame", "1", "-o", "a.png"), "--frame; did you mean --frames?"),
            (render, (MATTE, "--nothing-like-it", "3", "-o", "a.png"), "option --nothing-like-it"),
            (render, (MATTE, "a.png"), "'a.png' is one word too many"),
            (convert, (MATTE, "a.dae", "--strickt"), "--strickt; did you mean --strict?"),
            (validate, (MATTE, "--sevrity", "XML_*=off"), "did you mean --severity?"),
            (shade, ("run", "a.sl", "--iteration", "4"), "did you mean --iterations?"),
        ]
        for program, words, text in rows:
            with self.subTest(words=words):
                self.expect(program(*words), 2, text)

    def test_every_program_says_its_name_with_what_is_wrong(self):
        for program in PROGRAMS:
            with self.subTest(program):
                result = run(program)
                self.expect(result, 2, f"{program}: ", f"{program} --help")
                self.expect(run(program, "--version"), 0, program)
                self.expect(run(program, "--help"), 0, "Exit codes")

    def test_one_time_is_not_several_frames(self):
        words = (MATTE, "-o", self.folder / "a.png", "--time", "1", "--frames", "3")
        self.expect(render(*words), 2, "--time", "--frames")

    def test_materials_that_are_not_there_are_usage_errors_everywhere(self):
        shader = f"nobody={SHADERS / 'plastic.sl'}"
        self.expect(render(MATTE, "-o", self.folder / "a.png", "--shader", shader), 2, "nobody")
        for out in ("a.dae", "a.glb"):
            self.expect(convert(MATTE, self.folder / out, "--shader", shader), 2, "nobody")


if __name__ == "__main__":
    main()
