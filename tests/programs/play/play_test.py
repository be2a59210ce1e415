"""tests/programs/play/play_test.py: kinora-play without a window: scripts, screenshots, exit codes."""
import json
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
import written_scenes
from programs import MATTE, SCENES, SOURCE, ProgramTest, main, render, run

sys.path.insert(0, str(SOURCE / "scripts/sheet"))
import png  # noqa: E402

SMALL = ("--size", "64x36", "--spp", "2", "--threads", "2")


def play(*words, **options):
    return run("kinora-play", *words, **options)


class Play(ProgramTest):
    def script(self, scene, text, *words):
        return play(scene, "--headless", "--script", self.write("script.txt", text), *SMALL, *words)

    def check_same(self, scene, frame, *words):
        """The screenshot and the file of kinora-render have the same pixels."""
        shot, file = self.folder / "play.png", self.folder / "render.png"
        self.expect(play(scene, "--headless", "--screenshot", shot, "--frames", frame, *SMALL, *words), 0)
        self.expect(render(scene, "-o", file, "--frames", frame, *SMALL, *words), 0)
        self.assertEqual(png.read(shot), png.read(file))

    def test_a_screenshot_is_the_frame_of_kinora_render(self):
        self.check_same(SCENES / "walker.dae", 12)
        self.check_same(SCENES / "tintoy.dae", 3)
        self.check_same(SOURCE / "assets/gltf/bender.glb", 20)

    def test_with_the_same_options(self):
        self.check_same(MATTE, 0, "--camera", "top", "--lights", "default", "--exposure", "1", "--param", "bright.Kd=0.2",
                        "--background", "0.1,0.2,0.3", "--scale", "50%")

    def test_the_camera_is_the_one_that_kinora_render_chooses(self):
        """Not for a moment the file's, which makes no picture: several runs, since that was by chance."""
        for optics in ("<aspect_ratio>1</aspect_ratio>", "<yfov>200</yfov>", "<yfov>0</yfov>"):
            optics = f"<perspective>{optics}<znear>.1</znear><zfar>100</zfar></perspective>"
            cam, eye = written_scenes.camera(optics)
            scene = self.write("scene.dae", written_scenes.document(
                cam + written_scenes.WHITE + written_scenes.geometries(written_scenes.square()),
                eye + written_scenes.place()))
            for _ in range(8):
                with self.subTest(optics=optics):
                    result = play(scene, "--headless", "--screenshot", self.folder / "play.png", *SMALL)
                    self.expect(result, 0, "CAMERA_SEES_LITTLE")
                    self.assertNotIn("CAMERA_OPTICS", result.err)
            self.check_same(scene, 0)

    def test_maps_of_a_films_earlier_pictures(self):
        """Each frame looks up a map that it makes itself, under the same name, and one that the first has made."""
        self.write("paint.sl", 'surface paint(string a = "", b = "";) { Oi = 1; Ci = texture(a, s, t) + texture(b, s, t); }')
        wall = 'Polygon "P" [-1 -1 3 1 -1 3 1 1 3 -1 1 3] "st" [0 1 1 1 1 0 0 0]\n'

        def world(frame, display, inside):
            return (f'FrameBegin {frame}\nDisplay "{display}.tif" "file" "rgb"\nWorldBegin\n{inside}WorldEnd\nFrameEnd\n'
                    f'MakeTexture "{display}.tif" "{display}.tx" "clamp" "clamp" "box" 1 1\n')

        half = 'Polygon "P" [-1 -1 2 0 -1 2 0 1 2 -1 1 2]\n'
        text = 'Format 32 32 1\n' + world(100, "all", f'Surface "constant" Color .3 0 0 {half}')
        for frame in (1, 2, 3):
            text += world(100 + frame, "own", f'Surface "constant" Color 0 {frame / 4} .5 {half}')
            text += world(frame, "picture", f'Surface "paint" "string a" "all.tx" "string b" "own.tx" {wall}')
        scene = self.write("scene.rib", text)
        options = ("--spp", "2", "--threads", "2")
        self.expect(render(scene, "-o", self.folder / "r.####.png", *options), 0)
        self.expect(self.play_frames(scene, (3, 1, 2, 1), *options), 0)
        for frame in (1, 2, 3):
            self.assertEqual(png.read(self.folder / f"p{frame}.png"), png.read(self.folder / f"r.{frame:04}.png"))

    def play_frames(self, scene, frames, *words):
        """A screenshot of each, in turn."""
        lines = "".join(f"seek {frame}\nwait refined\nscreenshot {self.folder}/p{frame}.png\n" for frame in frames)
        return play(scene, "--headless", "--script", self.write("script.txt", lines), *words)

    def test_frames_need_a_token(self):
        self.expect(play(MATTE, "--headless", "--screenshot", self.folder / "a.png", "--frames", "0-1", *SMALL), 2, "####")
        self.expect(play(MATTE, "--headless", "--screenshot", self.folder / "a.##.png", "--frames", "0-1", *SMALL), 0)
        self.assertEqual(len(self.pictures()), 2)

    def test_scripts(self):
        shot, stats = self.folder / "shot.png", self.folder / "stats.json"
        text = f"seek 12  # a frame\norbit 30 10\nscreenshot {shot}\nstats {stats}\nexpect time 12\n"
        self.expect(self.script(SCENES / "walker.dae", text), 0)
        width, height = png.read(shot)[:2]
        self.assertEqual((width, height), (64, 36))
        self.assertGreaterEqual(json.loads(stats.read_text())["frames"], 1)

    def test_the_same_script_gives_the_same_bytes(self):
        found = set()
        for turn in range(2):
            shot = self.folder / f"{turn}.exr"
            text = f"orbit 12 7\nplay on\nwait 0.4\nplay off\nscreenshot {shot}\n"
            self.expect(self.script(SCENES / "walker.dae", text), 0)
            found.add(shot.read_bytes())
        self.assertEqual(len(found), 1)

    def test_errors_of_scripts_have_a_place(self):
        result = self.script(MATTE, "seek 0\n  orbitt 3\n")
        self.expect(result, 1, "script.txt:2:3: error: there is no command 'orbitt'; did you mean 'orbit'?")
        self.expect(self.script(MATTE, "expect time 3\n"), 1, "the frame is 0, not 3")
        self.expect(self.script(MATTE, "expect pixel 0 0 255 0 255\n"), 1, "the pixel is")

    def test_usage(self):
        self.expect(play(MATTE, "--headless"), 2, "--script FILE or --screenshot FILE")
        self.expect(play("--headless"), 2, "needs a scene")
        self.expect(play(self.folder / "none.dae", "--headless"), 3, "there is no file", "none.dae")
        self.expect(play(MATTE, "--headless", "--script", self.folder / "none.txt"), 2, "cannot be read")
        self.expect(play(MATTE, "--headless", "--scrip", "a"), 2, "--script")
        self.expect(play(self.folder / "none.dae", "--headless", "--screenshot", "a.png"), 3)
        self.expect(play(MATTE, "--headless", "--screenshot", "/proc/none/a.png", *SMALL), 6, "cannot be written")
        self.expect(play(MATTE, "--camera", "nosuch", "--headless", "--screenshot", "a.png"), 2)

    def test_it_explains_what_kinora_render_explains(self):
        for scene in (SCENES / "walker.dae", SCENES / "attach.dae", SOURCE / "assets/gltf/bender.glb"):
            with self.subTest(scene.name):
                file = self.folder / "explained.json"
                # Some of it is told of the frame that was made last.
                self.expect(self.script(scene, f"seek 1\nwait refined\nexplain {file}\n", "--quality", "preview"), 0)
                wanted = render(scene, "--explain=json", "--frames", 1, "-o", self.folder / "explained.png", *SMALL, "--quality", "preview")
                self.expect(wanted, 0)
                self.assertEqual(json.loads(file.read_text()), json.loads(wanted.out))
                self.assertIn("shaders", json.loads(file.read_text()))

    def test_a_shader_that_loops_for_ever_ends(self):
        shot = self.folder / "a.png"
        text = 'select_material bright\nedit\nset_text "surface s() { float x = 0; while (x < 1) x = x - 1; Ci = x; }"\n' \
               f'wait refined\nset_text "surface s() {{ Ci = color(0, 1, 0); }}"\nwait refined\nscreenshot {shot}\n'
        self.script(MATTE, text)
        self.assertTrue(shot.exists())

    def test_what_is_missing_is_an_error_where_that_is_asked_for(self):
        texture = 'Ci = texture("none_of_this_name.png");'
        shader = self.write("t.sl", "surface t() { " + texture + " }")
        words = (MATTE, "--headless", "--screenshot", self.folder / "a.png", "--shader", f"*={shader}", *SMALL)
        strict = play(*words, "--strict")
        self.assertEqual(strict.code, render(MATTE, "-o", self.folder / "b.png", "--frames", "0", "--shader", f"*={shader}", *SMALL,
                                             "--strict").code, strict)
        self.assertEqual(strict.code, 5, strict)
        self.expect(play(*words), 0)

    def test_a_recorded_session_runs_again(self):
        record, shot, again = (self.folder / name for name in ("record.txt", "a.exr", "b.exr"))
        self.expect(self.script(SCENES / "walker.dae", f"orbit 20 5\nseek 9\nscreenshot {shot}\n", "--record", record), 0)
        text = record.read_text().replace(str(shot), str(again))
        self.expect(self.script(SCENES / "walker.dae", text), 0)
        self.assertEqual(shot.read_bytes(), again.read_bytes())


if __name__ == "__main__":
    main()
