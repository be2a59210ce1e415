"""tests/programs/shade/shade_test.py: kinora-shade, the shader writer's tool."""
import json
import re
import resource
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from programs import MATTE, SCENES, SHADERS, SOURCE, ProgramTest, main, shade, supported_targets

sys.path.insert(0, str(SOURCE / "scripts"))
from sheet import png  # noqa: E402

MATTE_SHADER = SHADERS / "matte.sl"
BROKEN = "surface x(float Kd = 1;)\n{\n    Ci = Kd * diffus(N);\n}\n"


def ranges(result):
    """Output component -> (lowest, highest) that `run` printed."""
    rows = re.findall(r"^(\S+)\s+(\S+) to (\S+), mean", result.out, re.M)
    return {name: (float(low), float(high)) for name, low, high in rows}


class Check(ProgramTest):
    def test_every_shader_of_ours_is_clean(self):
        for file in sorted(SHADERS.glob("*.sl")):
            with self.subTest(file=file.name):
                # All four models of COLLADA have the same parameters.
                model = ["-Wno-unused-parameter"] if file.stem.startswith("collada_") else []
                self.expect(shade("check", file, *model), 0, "0 errors, 0 warnings")

    def test_errors_have_their_place_and_exit_4(self):
        file = self.write("x.sl", BROKEN)
        self.expect(shade("check", file), 4, "x.sl:3:15: error", "did you mean 'diffuse'",
                    "1 error")

    def test_reads_standard_input(self):
        self.expect(shade("check", "-", stdin=BROKEN), 4, "<stdin>:3:15: error")

    def test_errors_inside_a_scene_have_the_scene_s_place(self):
        text = MATTE.read_text().replace("diffuse(", "difuse(")
        scene = self.write("s.dae", text)
        line, row = next((i, r) for i, r in enumerate(text.splitlines(), 1) if "difuse(" in r)
        place = f"s.dae:{line}:{row.index('difuse(') + 1}: error"
        self.expect(shade("check", f"{scene}#Matte"), 4, place)
        self.expect(shade("check", f"{MATTE}#Matte"), 0, "surface matte")

    def test_unknown_effects_are_usage_errors_that_name_the_known(self):
        self.expect(shade("check", f"{MATTE}#none"), 2, "Matte")
        self.expect(shade("info", SCENES / "walker.dae"), 2, "name an effect", "statue-rsl")

    def test_missing_files_exit_3(self):
        for source in (self.folder / "none.sl", f"{self.folder}/none.dae#x", self.folder):
            self.expect(shade("check", source), 3)

    def test_macros_and_includes(self):
        self.write("inc/k.h", "#define HALF 0.5\n")
        file = self.write("x.sl", '#include "k.h"\nsurface x() { Ci = HALF * TWICE; Oi = 1; }\n')
        self.expect(shade("check", file), 4, "k.h")
        self.expect(shade("check", file, "-I", self.folder / "inc"), 4, "TWICE")
        words = (file, "-I", self.folder / "inc", "-D", "TWICE=2")
        self.expect(shade("check", *words), 0)
        self.expect(shade("check", *words, "-U", "TWICE"), 4, "TWICE")
        self.expect(shade("check", *words, "-E"), 0, "Ci = 0.5 * 2")

    def test_werror_turns_a_warning_into_exit_4(self):
        file = self.write("x.sl", "surface x(float k = 1;) { k = 2; Ci = k; }\n")
        self.expect(shade("check", file), 0, "1 warning")
        self.expect(shade("check", file, "-Werror"), 4)


    def test_several_sources_are_checked_and_the_worst_tells(self):
        bad = self.write("bad.sl", "surface x() { Ci = y; }")
        good = [SHADERS / "plastic.sl", SHADERS / "wood.sl"]
        self.expect(shade("check", *good), 0, "surface plastic", "surface wood")
        self.expect(shade("check", good[0], bad, good[1]), 4, "bad.sl:1:20", "surface wood")
        self.expect(shade("check", bad, self.folder / "none.sl", good[0]), 3, "surface plastic")

    def test_a_scene_stands_for_all_its_effects(self):
        self.expect(shade("check", MATTE), 0, "matte.dae#Matte: 0 errors")
        self.expect(shade("info", MATTE), 0, 'surface "matte"')  # it has only one
        names = re.findall(r"walker.dae#(\S+):", self.expect(
            shade("check", SCENES / "walker.dae"), 0).out)
        self.assertGreater(len(names), 4)
        self.expect(shade("info", SCENES / "walker.dae"), 2, "name an effect", names[0])

    def test_json_holds_the_findings_with_their_places(self):
        bad = self.write("bad.sl", "surface x()\n{\n    Ci = diffus(N);\n}\n")
        result = self.expect(shade("check", bad, MATTE, "--json"), 4)
        self.assertEqual(result.err, "")
        broken, clean = json.loads(result.out)
        self.assertEqual((broken["ok"], clean["ok"]), (False, True))
        self.assertEqual(clean["shaders"], [{"name": "matte", "kind": "surface"}])
        finding = broken["findings"][0]
        self.assertEqual((finding["severity"], finding["line"], finding["column"]), ("error", 3, 10))
        self.assertIn("diffuse", finding["help"])

    def test_quiet_stands_before_or_behind_the_command(self):
        for words in (("-q", "check"), ("check", "-q")):
            result = self.expect(shade(*words, SHADERS / "plastic.sl"), 0)
            self.assertEqual(result.out + result.err, "")


class Info(ProgramTest):
    def test_tells_parameters_and_globals(self):
        self.expect(shade("info", SHADERS / "plastic.sl"), 0, 'surface "plastic"',
                    "uniform float Ks = 0.5", "uniform color specularcolor", "writes Ci Oi")

    def test_json_says_the_same(self):
        file = self.write("x.sl", 'displacement x(float a[2] = {1, 2}; varying point q = 0;'
                                  ' output varying color c = 0; string s = "t";) { N = N; }')
        shader = json.loads(self.expect(shade("info", "--json", file), 0).out)["shaders"][0]
        self.assertEqual((shader["name"], shader["kind"]), ("x", "displacement"))
        rows = {row["name"]: row for row in shader["parameters"]}
        self.assertEqual(rows["a"]["array"], 2)
        self.assertEqual(rows["a"]["value"], [1, 2])
        self.assertEqual((rows["q"]["type"], rows["q"]["detail"]), ("point", "varying"))
        self.assertTrue(rows["c"]["output"])
        self.assertEqual(rows["s"]["value"], ["t"])
        self.assertIn("N", shader["writes"])

    def test_a_class_has_methods_members_and_annotations(self):
        file = SOURCE / "tests/rsl/constructs/classes/class_of_the_seed.sl"
        self.expect(shade("info", file), 0, 'class, as surface "rslTwoShader"',
                    "methods construct begin displacement opacity prelighting lighting"
                    " postlighting userCreatedFunc", "member varying float classVar",
                    'annotation base "gadgettype=colorslider"')
        shader = json.loads(self.expect(shade("info", "--json", file), 0).out)["shaders"][0]
        self.assertIn("opacity", shader["methods"])
        self.assertIn({"name": "classVar", "type": "float", "detail": "varying"},
                      shader["members"])
        self.assertEqual(len(shader["annotations"]), 2)


class Run(ProgramTest):
    def test_parameters_reach_the_shader(self):
        file = self.write("x.sl", "surface x(float f = 1; color c = 1; float a[3] = {1, 1, 1};)"
                                  "{ Ci = color(f, comp(c, 1), a[2]); Oi = 1; }")
        words = ("--size", "4x4", "--param", "f=0.5", "--param", "c=0,0.25,0", "--param", "a=7,8,9")
        got = ranges(self.expect(shade("run", file, *words), 0))
        self.assertEqual(got, {"Ci.r": (0.5, 0.5), "Ci.g": (0.25, 0.25), "Ci.b": (9, 9)})

    def test_wrong_parameters_and_outputs_are_explained(self):
        plastic = SHADERS / "plastic.sl"
        self.expect(shade("run", plastic, "--param", "kd=1"), 2, "did you mean 'K")
        self.expect(shade("run", plastic, "--param", "Kd=a"), 2, "'a' is no float")
        self.expect(shade("run", plastic, "--param", "Kd=1,2"), 2, "takes 1 number, not 2")
        self.expect(shade("run", plastic, "--param", "Kd"), 2, "NAME=VALUE")
        self.expect(shade("run", plastic, "--output", "Cj"), 2, "did you mean 'Ci'")
        lists = self.write("lists.sl", "surface x(output varying color c[2] = {1, 1};) { c[1] = s; Ci = 1; }")
        for wrong in ("c", "c.2", "c.x", "Ci.0"):
            self.expect(shade("run", lists, "--output", wrong), 2, f"'{wrong}' is no output")
        got = ranges(self.expect(shade("run", lists, "--output", "c.0", "--size", "4x4"), 0))
        self.assertEqual(got, {"aov:c[0].r": (1, 1), "aov:c[0].g": (1, 1), "aov:c[0].b": (1, 1)})
        self.expect(shade("run", plastic, "--size", "4"), 2, "--size")
        self.expect(shade("run", plastic, "-o", "a.gif"), 2, ".png")
        self.expect(shade("run", plastic, "--shader", "x"), 2, "plastic")

    def test_the_square_has_the_globals_that_hand_arithmetic_gives(self):
        rows = {  # of a 2x2 grid on the unit square: u and v are 0.25 or 0.75
            "u": (0.25, 0.75), "t": (0.25, 0.75), "du": (0.5, 0.5),
            "xcomp(dPdu)": (1, 1), "ycomp(dPdv)": (1, 1), "zcomp(N)": (-1, -1),
            "area(P)": (0.25, 0.25), 'xcomp(transform("object", P))': (0.25, 0.75),
            "length(E)": (0, 0), "depth(P)": (1 / 99, 1 / 99), "Du(s * s)": (0.5, 1.5),
        }
        for expression, (low, high) in rows.items():
            with self.subTest(expression=expression):
                source = f"surface x() {{ Ci = color(float({expression})); Oi = 1; }}"
                result = self.expect(shade("run", "-", "--size", "2x2", stdin=source), 0)
                got = ranges(result)["Ci.r"]
                self.assertAlmostEqual(got[0], low, places=5)
                self.assertAlmostEqual(got[1], high, places=5)

    def test_the_sphere_s_normal_agrees_with_its_derivatives(self):
        source = ("surface x() { normal n = normalize(N); point c = P - N;"
                  "Ci = color(n . normalize(dPdv ^ dPdu), length(N), zcomp(c)); Oi = 1; }")
        got = ranges(self.expect(shade("run", "-", "--sphere", "--size", "64x64", stdin=source), 0))
        self.assertAlmostEqual(abs(got["Ci.r"][0]), 1, places=3)
        self.assertAlmostEqual(got["Ci.r"][0], got["Ci.r"][1], places=3)
        self.assertAlmostEqual(got["Ci.g"][1], 1, places=5)
        self.assertAlmostEqual(got["Ci.b"][0], 4, places=5)

    def test_outputs_are_aovs_normals_and_lights(self):
        source = "surface x(output varying float k = 0;) { k = 3; Ci = 0; Oi = 1; }"
        result = shade("run", "-", "--output", "k", "--size", "4x4", stdin=source)
        got = ranges(self.expect(result, 0))
        self.assertEqual(got, {"aov:k": (3, 3)})
        plastic = SHADERS / "plastic.sl"
        self.expect(shade("run", plastic, "--output", "N", "--size", "4x4"), 0, "N.z")
        light = ranges(self.expect(shade("run", SHADERS / "pointlight.sl", "--size", "3x3"), 0))
        self.assertAlmostEqual(light["Ci.r"][1], 1, places=4)  # straight below, at distance 1

    def test_writes_pictures_and_says_when_it_cannot(self):
        for name in ("a.png", "a.exr"):
            words = ("run", SHADERS / "wood.sl", "--size", "16x16", "-o", self.folder / name)
            self.expect(shade(*words), 0)
        self.assertEqual(list(self.pictures()), ["a.exr", "a.png"])
        self.write("file", "")
        self.expect(shade("run", SHADERS / "wood.sl", "-o", self.folder / "file/a.png"), 6)

    def test_our_shaders_agree_with_interpreter_and_reference(self):
        for file in sorted(SHADERS.glob("*.sl")):
            if re.search(r"^(volume|imager|transformation) ", file.read_text(), re.M):
                continue
            for shape in ((), ("--sphere",)):
                with self.subTest(file=file.name, shape=shape):
                    words = ("run", file, "--size", "40x40", *shape, "--compare")
                    self.expect(shade(*words, "interp"), 0, "interp: 0 of ")
                    result = self.expect(shade(*words, "reference"), 0, " points compared")
                    self.assertGreater(int(re.search(r"(\d+) points comp", result.out)[1]), 0)
                    worst = re.search(r"largest difference (\S+):", result.out)
                    self.assertLess(float(worst[1]) if worst else 0, 1e-4, result)

    def test_a_coordinate_system_of_no_scene_is_the_world_and_said_so(self):
        source = 'surface x() { Ci = color transform("hand", P) + color transform("world", P); }'
        words = ("run", "-", "-v", "--size", "4x4", "--compare", "reference")
        result = self.expect(shade(*words, stdin=source), 0, "16 points compared", "no difference")
        self.assertEqual(result.err.count("'hand'"), 1, result.err)
        self.assertNotIn("'world'", result.err)

    def test_the_reference_is_asked_where_the_code_needs_no_service(self):
        folded = 'surface x(string a = "a.tif") { Ci = 0 * color texture(a); }'
        gathers = ('surface x() { color c = 0; float n = 0; gather("illuminance", P, N, 1, 4, '
                   '"surface:Ci", c) n += 1; else n += 10; Ci = c + n; }')
        points = ('surface x() { float a = 2; float ok = texture3d("a.ptc", P, N, "_a", a); '
                  'Ci = a + ok; }')
        for source in (folded, gathers, points):
            words = ("run", "-", "--size", "4x4", "--compare", "reference")
            self.expect(shade(*words, stdin=source), 0, "16 points compared", "no difference")

    def test_faults_have_the_loop_s_place(self):
        source = "surface x() {\n float i = 0;\n while (i > -1) i += 1;\n Ci = i; }"
        self.expect(shade("run", "-", "--size", "1x1", stdin=source), 0, "<stdin>:3:2: warning")

    def test_shader_kinds_that_do_not_run_are_refused(self):
        for kind in ("volume", "imager", "transformation"):
            source = f"{kind} x() {{ }}"
            self.expect(shade("run", "-", "--size", "2x2", stdin=source), 2, kind)
            self.expect(shade("check", "-", stdin=source), 0)


class DumpBenchManual(ProgramTest):
    def test_every_stage_shows_its_work(self):
        rows = {"tokens": "name surface", "ast": "surface constant", "types": "Cs{color varying}",
                "ir": "; stage ir", "ir:fold": "; stage ir:fold", "asm": "; stage asm"}
        for stage, text in rows.items():
            with self.subTest(stage=stage):
                self.expect(shade("dump", "--stage", stage, SHADERS / "constant.sl"), 0, text)
        self.expect(shade("dump", "--stage", "x", SHADERS / "constant.sl"), 2, "tokens, ast")
        self.expect(shade("dump", "--stage", "ir:x", SHADERS / "constant.sl"), 2, "ir:fold")

    def test_a_picture_beside_a_color_is_a_color_and_noise_a_factor(self):
        source = ('surface x() { color c = Cs * texture("a"); c *= environment("b", N);\n'
                  "c += 0.5 * Cs * trace(P, I); c *= noise(P); Ci = c * noise(u); }")
        out = self.expect(shade("dump", "--stage", "types", "-", stdin=source), 0).out
        for name in ("texture", "environment", "trace"):
            self.assertRegex(out, rf"{{color varying {name}#\d}}")
        self.assertEqual(len(re.findall(r"{float varying noise#\d}", out)), 2)

    def test_defaults_of_parameters_are_in_shader_space(self):
        source = 'light x(point a = (1, 2, 3); vector b = vector "world" (0, 0, 1);) { Cl = 1; }'
        self.expect(shade("dump", "--stage", "types", "-", stdin=source), 0,
                    'a = point "shader" (1, 2, 3)', 'b = vector "world" (0, 0, 1)')

    def test_bench_times_every_target(self):
        result = shade("bench", SHADERS / "matte.sl", "--size", "64x64", "--iterations", "2")
        self.expect(result, 0, "median", "Mpoints/s")
        self.assertEqual(result.out.count("Mpoints/s"), len(supported_targets()))

    def test_bench_tells_the_same_as_json(self):
        words = ("bench", SHADERS / "matte.sl", "--size", "32x32", "--iterations", "2", "--json")
        bench = json.loads(self.expect(shade(*words), 0).out)
        self.assertEqual([row["target"] for row in bench["targets"]],
                         re.findall(r"^(\w+): ms", shade(*words[:-1]).out, re.M))
        for row in bench["targets"]:
            self.assertEqual(row["points"], 32 * 32)
            self.assertGreater(row["mpoints_per_second"], 0)
            self.assertAlmostEqual(sum(v for k, v in row["median"].items() if k != "total_ms"),
                                   row["median"]["total_ms"], places=6)

    def test_check_warns_of_slips_and_each_warning_can_be_left_out(self):
        source = ("float spare(float x) { return x; }\n"
                  'surface x(float Kd = 1;) { float a = 2; Ci = texture("nosuch.tex"); }')
        result = self.expect(shade("check", "-", stdin=source), 0, "0 errors, 4 warnings", "RSL_UNUSED_FUNCTION",
                             "RSL_UNUSED_PARAMETER", "RSL_UNUSED_VARIABLE", "RSL_TEXTURE_MISSING")
        self.assertIn("<stdin>:2:34: warning: variable 'a' is not used", result.err)
        left = self.expect(shade("check", "-", "-Wno-unused-variable", "-Wno-texture-missing", stdin=source), 0,
                           "0 errors, 2 warnings")
        self.assertNotIn("RSL_UNUSED_VARIABLE", left.err)
        self.assertIn("RSL_UNUSED_FUNCTION", left.err)
        by_code = self.expect(shade("check", "-", "-Wno-RSL_UNUSED_VARIABLE", stdin=source), 0, "3 warnings")
        self.assertNotIn("RSL_UNUSED_VARIABLE", by_code.err)  # the code as `check` prints it
        self.expect(shade("check", "-", "-Werror", stdin=source), 4)
        self.expect(shade("check", "-", "-Wno-unused-varable", stdin=source), 2, "did you mean 'unused-variable'")
        codes = [f["code"] for f in json.loads(shade("check", "-", "--json", "-Wno-unused-function",
                                                     stdin=source).out)[0]["findings"]]
        self.assertEqual(sorted(codes), ["RSL_TEXTURE_MISSING", "RSL_UNUSED_PARAMETER", "RSL_UNUSED_VARIABLE"])

    def test_run_shows_no_more_prints_than_a_frame(self):
        chatty = self.write("chatty.sl", 'surface chatty() { printf("%f\\n", s); Ci = 1; }')
        many = self.expect(shade("run", chatty, "--size", "128x128"), 0, "PRINT_LIMIT", "16384 lines")
        self.assertEqual(sum(re.fullmatch(r"[0-9.]+", line) is not None for line in many.out.splitlines()), 10000)
        few = self.expect(shade("run", chatty, "--size", "64x64"), 0)
        self.assertNotIn("PRINT_LIMIT", few.err)
        self.assertEqual(sum(re.fullmatch(r"[0-9.]+", line) is not None for line in few.out.splitlines()), 4096)

    def test_a_light_looks_along_z(self):
        light = self.write("beam.sl", 'light beam() { solar(vector "shader" (0, 0, 1), 0) Cl = 1; }')
        sizes = []
        for words in ((), ("--flip",)):
            picture = self.folder / f"a{len(words)}.png"
            self.expect(shade("run", light, "--size", "32x32", "-o", picture, *words), 0)
            _, _, rows = png.read(picture)
            sizes.append(max(max(row) for row in rows))
        self.assertGreater(sizes[0], 100)
        self.assertEqual(sizes[1], 0)

    def test_the_manual_has_an_example_of_every_statement_that_compiles(self):
        examples = re.findall(r"```c\n(.*?)```", shade("manual", "--markdown", "statements").out, re.S)
        self.assertGreaterEqual(len(examples), 24)
        for example in examples:
            with self.subTest(example):
                self.expect(shade("check", "-", stdin=example), 0, "0 errors, 0 warnings")
        words = re.findall(r'WORD\(\w+, "(\w+)"\)', (SOURCE / "rsl/text/words.def").read_text())
        types = "float color point vector normal matrix string void".split()
        for word in [w for w in words if w not in types] + ["#include", "define", "#endif", "atmosphere"]:
            with self.subTest(word):
                self.expect(shade("manual", word), 0, word)

    def test_the_manual_says_how_a_scene_uses_each_kind_of_shader(self):
        for kind in ("surface", "displacement", "light", "volume", "imager", "transformation"):
            with self.subTest(kind):
                self.expect(shade("manual", kind), 0, f'<shader stage="{kind.upper()}"/>', "instance_effect")

    def test_the_manual_knows_the_globals(self):
        self.expect(shade("manual", "Ng"), 0, "normal Ng", "geometric normal", "read by surface")
        self.expect(shade("manual", "dPd"), 2, "did you mean 'dPd")

    def test_the_manual_knows_the_built_ins(self):
        self.expect(shade("manual", "smoothstep"), 0, "T smoothstep(T, T, T), T: float")
        self.expect(shade("manual", "smothstep"), 2, "did you mean 'smoothstep'")
        self.assertGreater(len(self.expect(shade("manual"), 0).out.splitlines()), 60)

    def test_help_and_wrong_commands(self):
        self.expect(shade("--help"), 0, "check", "bench", "Exit codes")
        self.expect(shade("--version"), 0, "kinora-shade ")
        for name in ("check", "info", "run", "dump", "bench", "tradeoff", "manual"):
            self.expect(shade(name, "--help"), 0)
        self.expect(shade(), 2)
        self.expect(shade("chek", "x.sl"), 2, "did you mean 'check'")
        self.expect(shade("check"), 2, "source")


def little_memory():
    resource.setrlimit(resource.RLIMIT_AS, (200_000_000, 200_000_000))


class Limits(ProgramTest):
    def test_arrays_beyond_32_bits_are_an_error_on_every_target(self):
        arrays = "".join(f" float a{k}[16000]; a{k}[s * 16000] = t + {k}; r += a{k}[t * 16000];\n"
                         for k in range(4195))
        file = self.write("arrays.sl", f"surface arrays() {{ float r = 0;\n{arrays}Ci = r; Oi = 1; }}\n")
        self.expect(shade("check", file), 4, "arrays.sl:18:8: error: array 'a16' brings", "1 error")
        for target in supported_targets():
            self.expect(shade("run", file, "--size", "3x3", "--target", target), 4, "RSL_ARRAYS_TOO_LARGE")

    def test_a_string_that_is_doubled_for_ever_is_told(self):
        file = self.write("long.sl", "surface doubled() { string a = \"x\"; float i;\n"
                          "for (i = 0; i < 36; i += 1)\n a = concat(a, a);\n"
                          "if (a == \"y\") Ci = 1; else Ci = s; Oi = 1; }\n")
        for target in supported_targets():
            result = self.expect(shade("run", file, "--size", "3x3", "--target", target), 0)
            self.assertEqual(result.err.count("long.sl:3:"), 1, result)
            self.assertIn("a string of more than 65536 bytes", result.err)

    def test_out_of_memory_in_a_service_ends_the_program_on_every_target(self):
        """The exception passes through the kernel."""
        file = self.write("many.sl", "surface many() { string a = \"x\"; float i;\n"
                          "for (i = 0; i < 15; i += 1) a = concat(a, a);\n"
                          "Ci = match(\"y$\", format(\"%s%f %f\", a, s, t)); Oi = 1; }\n")
        if shade("run", MATTE_SHADER, "--size", "4x4", preexec_fn=little_memory).code != 0:
            self.skipTest("the program does not start in so little memory")
        for target in supported_targets():
            with self.subTest(target=target):
                self.expect(shade("run", file, "--size", "128x128", "--target", target,
                                  preexec_fn=little_memory), 75, "kinora-shade: out of memory")


class Tradeoff(ProgramTest):
    def table(self, source, *words):
        result = shade("tradeoff", "-", "--size", "16x4", "--iterations", "2", "--json", *words, stdin=source)
        self.assertEqual(result.code, 0, result.err)
        return json.loads(result.out)

    def test_what_floats_hold_is_off_by_nothing(self):
        table = self.table("surface x() { Ci = 0.5 * u; }")
        self.assertEqual((table["points"], table["compared"], table["undecided"]), (64, 64, 0))
        self.assertEqual(table["rows"][0]["time"], 1)
        for row in table["rows"]:
            red = next(out for out in row["outputs"] if out["name"] == "Ci.r")
            self.assertEqual((red["max_ulp"], red["mean_ulp"], red["special"]), (0, 0, 0), row)
            self.assertEqual(red["histogram"], [64] + 7 * [0])
            self.assertEqual(row["points_changed"], 0)
            self.assertGreater(row["points_per_second"], 0)

    def test_rows_are_the_targets_and_tiers_that_run_here(self):
        rows = self.table("surface x() { Ci = sin(9 * u); }")["rows"]
        self.assertEqual({(row["target"], row["math"], row["derivatives"]) for row in rows},
                         {(target, math, True) for target in supported_targets()
                          for math in ("precise", "fast")})
        # One rounding of 9 u, times the slope of sin there, and those of sin itself; each output has
        # all of its values in some bin.
        for row in rows:
            red = next(out for out in row["outputs"] if out["name"] == "Ci.r")
            self.assertGreater(red["max_ulp"], 0)
            self.assertLessEqual(red["mean_ulp"], red["max_ulp"])
            self.assertEqual(sum(red["histogram"]), red["values"])
        worst = {row["math"]: max(out["mean_ulp"] for out in row["outputs"]) for row in rows}
        self.assertGreater(worst["fast"], worst["precise"])

    def test_derivatives_left_out_are_a_row_where_they_are_used(self):
        rows = self.table("surface x() { Ci = Du(3 * u * u); }", "--target", "interp")["rows"]
        self.assertEqual([row["derivatives"] for row in rows], [True, False, True, False])
        for row in rows:  # 6 u; or 0 instead, which is off by all of it: 2^23 to 2^24 ULP
            red = next(out for out in row["outputs"] if out["name"] == "Ci.r")
            self.assertEqual(red["max_ulp"] > 2 ** 22, not row["derivatives"], row)
            self.assertEqual(row["points_changed"], 0 if row["derivatives"] else 64)

    def test_points_that_branch_otherwise_are_counted_apart(self):
        # As floats u + 10^-9 is u from 1/32 on; as doubles it is more.
        table = self.table("surface x() { if (u + 1e-9 > u) Ci = 1; else Ci = 2; }")
        self.assertEqual((table["compared"], table["undecided"]), (0, 64))

    def test_infinities_and_NaN_are_no_ulps(self):
        # 10^60 and more is infinite as a float, as it should be; what is left of infinity is not.
        table = self.table("surface x() { float a = 1e20 * (1 + u); Ci = a * a * a; Oi = a * a * a - a * a * a; }")
        special = {"C": 0, "O": 64}
        for row in table["rows"]:
            for out in row["outputs"]:
                if out["name"][0] in special:
                    self.assertEqual((out["values"], out["special"]), (0, special[out["name"][0]]), out)

    def test_a_terminal_shows_errors_and_histograms(self):
        result = shade("tradeoff", SHADERS / "wood.sl", "--size", "16x16", "--iterations", "2")
        self.expect(result, 0, "branch or floor differently", "max ULP", "at most so many ULP", "interp")
        self.expect(shade("tradeoff", "-", stdin=BROKEN), 4, "did you mean 'diffuse'")


if __name__ == "__main__":
    main()
