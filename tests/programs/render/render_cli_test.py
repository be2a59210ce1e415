"""tests/programs/render/render_cli_test.py: what kinora-render says and how it exits."""
import json
import os
import resource
import signal
import subprocess
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
import written_scenes as scenes
from programs import MATTE, ProgramTest, command, main, render

SMALL = ("--size", "24x16", "--spp", "1", "--threads", "1")


class ExitCodes(ProgramTest):
    def test_usage_errors_exit_2_and_say_which_option(self):
        picture = self.folder / "a.png"
        rows = [
            ([], "scene"),
            ([MATTE], "-o"),
            ([MATTE, "-o", self.folder / "a.jpg"], ".png"),
            ([MATTE, "-o", picture, "--frames", "1-x"], "--frames"),
            ([MATTE, "-o", picture, "--frames", "5-1x1"], "no frame"),
            ([MATTE, "-o", picture, "--frames", "1-9x0"], "step"),
            ([MATTE, "-o", picture, "--frames", "1-2"], "####"),
            ([MATTE, "-o", picture, "--size", "10"], "--size"),
            ([MATTE, "-o", picture, "--size", "0x5"], "--size"),
            ([MATTE, "-o", picture, "--threads", "0"], "--threads"),
            ([MATTE, "-o", picture, "--target", "z80"], "--target"),
            ([MATTE, "-o", picture, "--quality", "best"], "--quality"),
            ([MATTE, "-o", picture, "--fps", "0"], "--fps"),
            ([MATTE, "-o", picture, "--shader", "x.sl"], "--shader"),
            ([MATTE, "-o", picture, "--threads", "100000"], "--threads"),
            ([MATTE, "-o", picture, "--time", "nan"], "--time"),
            ([MATTE, "-o", picture, "--time", "1e300"], "--time"),
            ([MATTE, "-o", picture, "--filter-width", "nan"], "--filter-width"),
            ([MATTE, "-o", picture, "--filter-width=-1"], "--filter-width"),
            ([MATTE, "-o", picture, "--unit", "0"], "--unit"),
            ([MATTE, "-o", picture, "--background", "0,nan,0"], "--background"),
            ([MATTE, "-o", picture, "--seed", "x"], "--seed"),
            ([MATTE, "-o", picture, "--dump", "tokens"], "--dump"),
            ([MATTE, "-o", picture, "--camera", "none"], "none"),
            ([MATTE, "-o", picture, "--clip", "none"], "none"),
            ([MATTE, "-o", picture, "--no-such-option"], "--no-such-option"),
        ]
        for words, text in rows:
            with self.subTest(words=words):
                self.expect(render(*words), 2, text)
        self.assertEqual(self.pictures(), {})

    def test_unreadable_scenes_exit_3(self):
        text = self.write("text.dae", "no scene")
        empty = self.write("empty.dae", "")
        for scene in (self.folder / "missing.dae", text, empty, self.folder):
            with self.subTest(scene=scene):
                self.expect(render(scene, "-o", self.folder / "a.png", *SMALL), 3, "error")

    def test_broken_shaders_exit_4_with_their_place(self):
        bad = self.write("bad.sl", "surface x()\n{\n    Ci = diffus(N);\n}\n")
        result = render(MATTE, "--shader", f"*={bad}", "-o", self.folder / "a.png", *SMALL)
        self.expect(result, 4, "bad.sl:3:10: error", "did you mean 'diffuse'")
        missing = self.folder / "none.sl"
        result = render(MATTE, "--shader", f"*={missing}", "-o", self.folder / "a.png", *SMALL)
        self.expect(result, 4, "none.sl")

    def test_broken_shader_inside_the_scene_has_the_place_in_the_scene(self):
        text = MATTE.read_text()
        self.assertIn("diffuse(", text)
        scene = self.write("broken.dae", text.replace("diffuse(", "difuse("))
        rows = scene.read_text().splitlines()
        line = next(i for i, row in enumerate(rows, 1) if "difuse(" in row)
        column = rows[line - 1].index("difuse(") + 1
        result = render(scene, "-o", self.folder / "a.png", *SMALL)
        self.expect(result, 4, f"broken.dae:{line}:{column}: error")

    def test_an_unknown_coordinate_system_is_a_warning_and_an_error_under_strict(self):
        code = 'surface s() { Ci = xcomp(transform("nowhere", P)) + ycomp(transform("nowhere", P)); }'
        scene = self.write("space.dae", scenes.document(
            scenes.CAMERA + scenes.geometries(scenes.square()) + scenes.rsl(code), scenes.EYE + scenes.place()))
        words = (scene, "-o", self.folder / "space.png", "--size", "16x16")
        result = self.expect(render(*words), 0, "no coordinate system is named 'nowhere'; it is taken as 'shader'")
        self.assertEqual(result.err.count("RSL_SPACE_UNKNOWN"), 1)
        self.expect(render(*words, "--strict"), 4, "error: no coordinate system is named 'nowhere'")

    def test_unwritable_outputs_exit_6_and_leave_nothing(self):
        self.write("file", "not a folder")
        (self.folder / "taken.png").mkdir()
        endless = ("--size", "4000x4000", "--spp", "1000000")  # refused before it is rendered
        for name in ("file/a.png", "file/a.exr", "taken.png", "n" * 300 + ".png"):
            with self.subTest(name=name[:20]):
                self.expect(render(MATTE, "-o", self.folder / name, *endless), 6, "cannot write")
        sheet = ("--contact-sheet", self.folder / "file/a.png")
        self.expect(render(MATTE, *sheet, *endless), 6, "cannot write")
        self.assertEqual(sorted(f.name for f in self.folder.iterdir()), ["file", "taken.png"])

    def test_a_write_that_fails_half_way_leaves_nothing(self):
        def small_files():
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (120, 120))
        for name in ("a.png", "a.exr"):
            result = render(MATTE, "-o", self.folder / name, *SMALL, preexec_fn=small_files)
            self.expect(result, 6, "cannot write")
        # Beside the next frame: the run ends there, or every frame tells its own.
        frames = (MATTE, "-o", self.folder / "f.#.png", "--frames", "1-3", *SMALL[:-1], "2")
        result = render(*frames, preexec_fn=small_files)
        self.expect(result, 6, "f.1.png")
        self.assertNotIn("f.2.png", result.err)
        result = render(*frames, "--keep-going", preexec_fn=small_files)
        self.expect(result, 1, "f.1.png", "f.2.png", "f.3.png")
        self.assertEqual(list(self.folder.iterdir()), [])

    def test_keep_going_renders_the_frames_that_can_be(self):
        (self.folder / "f.0002.png").mkdir()
        words = (MATTE, "-o", self.folder / "f.####.png", "--frames", "1-3", *SMALL)
        self.expect(render(*words), 6)
        self.assertFalse((self.folder / "f.0003.png").exists())
        self.expect(render(*words, "--keep-going"), 1)
        self.assertTrue((self.folder / "f.0003.png").exists())


class Options(ProgramTest):
    def test_help_and_version_exit_0(self):
        self.expect(render("--help"), 0, "--frames", "--skip-existing", "Exit codes", "130")
        self.expect(render("--version"), 0, "kinora-render ")

    def test_stats_json_has_every_key(self):
        result = render(MATTE, "-o", self.folder / "f.##.png", "--frames", "1-2", "--stats=json",
                        *SMALL)
        self.expect(result, 0)
        stats = json.loads(result.out)
        for key in ("target", "lanes", "threads", "load_ms", "build_ms", "first_ray_ms", "kernels",
                    "compile_ms", "code_bytes", "peak_memory_bytes"):
            self.assertIn(key, stats)
        self.assertEqual([frame["frame"] for frame in stats["frames"]], [1, 2])
        for frame in stats["frames"]:
            stages = [key + "_ms" for key in
                      ("animate", "skin", "refit", "sample", "trace", "points", "gather", "lights",
                       "shadows", "kernels", "nested", "film", "imager", "idle", "other")]
            for key in (*stages, "write_ms", "displace_ms", "total_ms", "rays", "rays_per_second",
                        "shading_points", "points_per_second", "rays_per_pixel", "shadow_rays",
                        "nested_rays", "camera_occupancy", "shadow_occupancy", "nested_occupancy",
                        "file"):
                self.assertIn(key, frame)
            self.assertGreater(frame["rays"], 0)
            self.assertAlmostEqual(sum(frame[stage] for stage in stages), frame["total_ms"], 6)
            for stage in ("sample", "trace", "points", "kernels", "film"):
                self.assertGreater(frame[stage + "_ms"], 0, stage)

    def test_stats_count_rays_and_packets(self):
        # Every pixel's packet of 16 neighbours is whole; nothing shoots rays but the camera.
        words = ("-o", "null", "--size", "64x64", "--spp", "4", "--shadows", "off", "--stats=json")
        stats = json.loads(self.expect(render(MATTE, *words), 0).out)
        frame = stats["frames"][0]
        self.assertEqual(frame["camera_occupancy"], 1)
        self.assertEqual(frame["rays_per_pixel"], 4)
        self.assertEqual((frame["shadow_rays"], frame["nested_rays"]), (0, 0))

    def test_null_renders_and_writes_nothing(self):
        words = ("-o", "null", "--frames", "1-2", "--stats", *SMALL)
        result = self.expect(render(MATTE, *words), 0, "frame 2: ")
        self.assertNotIn(" write ", result.out)
        self.assertEqual(list(self.pictures()), [])

    def test_stats_as_text_go_to_stdout_too(self):
        result = render(MATTE, "-o", self.folder / "a.png", "--stats", *SMALL)
        self.expect(result, 0, " ms = ", "Mrays/s", "rays a pixel", "peak memory")

    def test_lists_what_is_in_the_scene(self):
        self.expect(render(MATTE, "--list"), 0, "camera", "range")
        for kind in ("cameras", "clips", "materials", "shaders", "lights"):
            self.expect(render(MATTE, "--list", kind), 0)

    def test_quiet_says_nothing_when_all_is_well(self):
        result = self.expect(render(MATTE, "-q", "-o", self.folder / "a.png", *SMALL), 0)
        self.assertEqual(result.out + result.err, "")

    def test_dumps_the_stages_of_the_kernels(self):
        self.expect(render(MATTE, "--dump=ir"), 0, "; stage ir")

    def test_frame_times_are_exact_at_ntsc_rates(self):
        words = ("-o", self.folder / "f.%08d.png", "--frames", "10000000", "--fps", "24000/1001",
                 "--stats=json", *SMALL)
        self.expect(render(MATTE, *words), 0)
        self.assertEqual(list(self.pictures()), ["f.10000000.png"])

    def test_a_range_in_which_nothing_moves_is_one_picture(self):
        text = Path(MATTE).read_text()
        ranged = text.replace("</visual_scene>", '<extra><technique profile="FCOLLADA"><start_time>0</start_time>'
                              "<end_time>0.2</end_time></technique></extra></visual_scene>")
        still, shimmering = self.folder / "still.dae", self.folder / "shimmering.dae"
        still.write_text(ranged)
        self.expect(render(still, "-o", self.folder / "a.png", *SMALL), 0, "(1/1)")
        self.expect(render(still, "-o", self.folder / "b.####.png", *SMALL), 0, "6 of 6 frames")
        shimmering.write_text(ranged.replace("Ci =", "Ci = time *", 1))
        self.assertNotEqual(shimmering.read_text(), ranged)
        self.expect(render(shimmering, "-o", self.folder / "a.png", *SMALL), 2, "frame token")

    def test_negative_frames_have_names(self):
        self.expect(render(MATTE, "-o", self.folder / "f.###.png", "--frames=-2--1", *SMALL), 0)
        self.assertEqual(list(self.pictures()), ["f.-001.png", "f.-002.png"])

    def test_a_contact_sheet_shows_the_frames(self):
        words = ("--contact-sheet", self.folder / "sheet.png", "--frames", "1-4", *SMALL)
        self.expect(render(MATTE, *words), 0)
        self.assertEqual(list(self.pictures()), ["sheet.png"])

    def test_missing_folders_are_made(self):
        self.expect(render(MATTE, "-o", self.folder / "a/b/c.exr", *SMALL), 0)
        self.assertTrue(os.path.getsize(self.folder / "a/b/c.exr") > 0)

    def test_a_closed_pipe_does_not_stop_it(self):
        read, write = os.pipe()
        os.close(read)
        words = command("kinora-render", MATTE, "-o", self.folder / "a.png", "--stats", *SMALL)
        code = subprocess.run(words, stdout=write, stderr=write, timeout=60).returncode
        os.close(write)
        self.assertEqual(code, 0)
        self.assertEqual(list(self.pictures()), ["a.png"])

    def test_output_parameters_become_channels_of_the_exr(self):
        shader = self.write("out.sl", "surface out(output varying color glow = 0;"
                                      " output varying float dirt = 0;)"
                                      " { glow = 1; dirt = 2; Oi = 1; Ci = 1; }")
        picture = self.folder / "a.exr"
        words = (MATTE, "--shader", f"*={shader}", "--time", "0", *SMALL)
        self.expect(render(*words, "--aov", "glow,dirt", "-o", picture), 0)
        header = picture.read_bytes()[:4096]
        for name in (b"glow.R\0", b"glow.G\0", b"glow.B\0", b"dirt\0", b"A\0", b"R\0"):
            self.assertIn(name, header)
        result = render(*words, "--aov", "nothing", "-o", picture)
        self.expect(result, 2, "AOV_UNKNOWN")
        self.assertIn(b"dirt\0", picture.read_bytes()[:4096])  # nothing was written

    def test_elements_of_output_arrays_become_channels(self):
        shader = self.write("out.sl", "surface out(output varying color lamps[3] = {0, 0, 0};"
                                      " output varying float weights[2] = {0, 0}; output varying float w = 0;)"
                                      " { lamps[1] = 1; weights[1] = 2; Oi = 1; Ci = 1; }")
        picture = self.folder / "a.exr"
        words = (MATTE, "--shader", f"*={shader}", "--time", "0", *SMALL)
        self.expect(render(*words, "--aov", "lamps,weights,w", "-o", picture), 0)
        header = picture.read_bytes()[:4096]
        for name in (b"lamps.0.R\0", b"lamps.2.B\0", b"weights.0\0", b"weights.1\0", b"w\0"):
            self.assertIn(name, header)
        self.assertNotIn(b"lamps.3.R\0", header)
        self.assertIn("lamps (color[3], of out)", render(*words, "--list", "aovs").out)

    def test_imagers_are_chosen_by_name_by_file_and_not_at_all(self):
        def picture(imager):
            file = self.folder / "a.png"
            self.expect(render(MATTE, "--time", "0", "--imager", imager, "-o", file, *SMALL), 0)
            return file.read_bytes()
        grey = self.write("grey.sl", "imager grey() { Ci = 0.5; alpha = 1; }")
        self.assertEqual(len({picture(i) for i in ("none", "background", grey)}), 3)
        result = render(MATTE, "--imager", "nosuch", "-o", self.folder / "b.png", *SMALL)
        self.expect(result, 2, "nosuch")


if __name__ == "__main__":
    main()
