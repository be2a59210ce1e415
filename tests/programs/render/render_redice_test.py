"""tests/programs/render/render_redice_test.py: frames whose camera comes closer to displaced meshes than the views they
were diced for at load are diced again, and are the same however they were asked for."""
import json
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from programs import MATTE, ProgramTest, main, render
from written_scenes import animation, animations, camera, document, geometries, place, png, square

LOOK = ('<library_effects><effect id="fx"><profile_RSL><technique sid="t"><code><![CDATA['
        'displacement hills(string other = "") { float h = 0; h = 0.15 * noise(4 * s, 4 * t) + 0.03 * noise(24 * s, 24 * t);'
        ' P += h * N; N = calculatenormal(P); }'
        'surface clay() { normal n = normalize(N); Oi = 1;'
        ' Ci = (0.1 + 0.9 * max(0, normalize(vector "world" (1, 0.4, 0.5)) . n)) * color(1, 0.7, 0.5); }'
        ']]></code><pass><shader stage="DISPLACEMENT"/><shader stage="SURFACE"/></pass></technique></profile_RSL>'
        '</effect></library_effects><library_materials><material id="mat"><instance_effect url="#fx"/></material>'
        '</library_materials>')
CAMERA = camera("<perspective><xfov>60</xfov><aspect_ratio>1</aspect_ratio><znear>0.01</znear><zfar>100</zfar>"
                "</perspective>")[0]
EYE = '<node id="eye"><translate sid="t">0.3 0.2 8</translate><instance_camera url="#cam"/></node>'
# Frames 10 and 11 of 24 lie between the 64 times that are looked at while the scene is loaded.
KEYS = [(0, 8)] + [key for n in (10, 11) for key in ((n / 24 - 0.004, 8), (n / 24, 0.9), (n / 24 + 0.004, 8))] + [(1, 8)]
DIVE = animation("dive", "eye/t.Z", [t for t, _ in KEYS], [z for _, z in KEYS])
CLIP = ('<library_animation_clips><animation_clip id="near" start="{0}" end="{0}"><instance_animation url="#dive"/>'
        '</animation_clip></library_animation_clips>').format(repr(10 / 24))
DIVING = document(CAMERA + LOOK + geometries(square(half=3)) + animations(DIVE) + CLIP, EYE + place())


class Redice(ProgramTest):
    def render(self, text, *words, out):
        """96 x 96 pixels in the numbers that shaders write."""
        return self.expect(render(self.write("scene.dae", text), "-o", self.folder / out, "--size", "96x96", "--spp",
                                  "4", "--color", "legacy", "--progress", "none", *words), 0)

    def frames(self, name, frames, *words, text=DIVING):
        """The files of the frames by name, and what --stats says."""
        self.folder.joinpath(name).mkdir()
        result = self.render(text, "--frames", frames, "--stats=json", *words, out=f"{name}/f.####.png")
        return self.pictures(self.folder / name), json.loads(result.out)

    def test_a_frame_is_the_same_alone_in_a_sequence_and_on_any_threads(self):
        all_frames, stats = self.frames("all", "8-13")
        self.assertEqual(stats["redices"], 2)
        self.assertGreater(stats["redice_ms"], 0)
        again = {frame["frame"] for frame in stats["frames"] if frame["redice_ms"] > 0}
        self.assertEqual(again, {10, 11})
        for frame in stats["frames"]:
            self.assertEqual(frame["dice_error"] > 2, frame["frame"] in again)
        for frame in (9, 10, 12):
            alone, stats = self.frames(f"one{frame}", str(frame))
            self.assertEqual(stats["redices"], int(frame == 10))
            self.assertTrue(alone.items() <= all_frames.items(), frame)
        backwards, _ = self.frames("back", "13-8x-1", "--threads", "1")
        self.assertTrue(backwards == all_frames)

    def rmse(self, a, b):
        rows = [png.read(path)[2] for path in (a, b)]
        squares = [(x - y) ** 2 for p, q in zip(*rows) for x, y in zip(p, q)]
        return (sum(squares) / len(squares)) ** 0.5

    def test_it_is_as_fine_as_where_the_scene_is_loaded_for_that_frame_alone(self):
        _, stats = self.frames("again", "10")
        self.assertEqual(stats["redices"], 1)
        _, stats = self.frames("clip", "10", "--clip", "near")
        self.assertEqual(stats["redices"], 0)
        # As it was without: edges so long that 2 x --dice lets them pass.
        _, stats = self.frames("coarse", "10", "--dice", "16")
        self.assertEqual(stats["redices"], 1)
        name = "f.0010.png"
        near = self.rmse(self.folder / "again" / name, self.folder / "clip" / name)
        coarse = self.rmse(self.folder / "coarse" / name, self.folder / "clip" / name)
        self.assertLess(near, 2)
        self.assertGreater(coarse, 3 * near)

    def test_frames_that_loading_sees_need_none(self):
        slow = animation("dive", "eye/t.Z", [0, 9 / 24, 10 / 24, 11 / 24, 12 / 24, 1], [8, 8, 0.9, 0.9, 8, 8])
        _, stats = self.frames("slow", "8-13", text=DIVING.replace(DIVE, slow))
        self.assertEqual(stats["redices"], 0)
        for frame in stats["frames"]:
            self.assertLess(frame["dice_error"], 1.5)

    def test_frames_outside_the_range_are_too(self):
        text = document(CAMERA + LOOK + geometries(square(half=3)) + animations(DIVE) +
                        CLIP.replace(f'end="{10 / 24!r}"', f'end="{9 / 24!r}"').replace(
                            f'start="{10 / 24!r}"', 'start="0"'), EYE + place())
        _, stats = self.frames("out", "9-12", "--clip", "near", text=text)
        self.assertEqual([frame["redice_ms"] > 0 for frame in stats["frames"]], [False, True, True, False])

    def test_it_is_told_where_it_is_asked_for(self):
        result = self.render(DIVING, "--frames", "9-11", "--stats", "--verbose", out="f.##.png")
        self.assertEqual(result.err.count("DICE_AGAIN"), 2, result)
        self.assertIn("diced again for 2 frames in", result.out)
        quiet = self.render(DIVING, "--frames", "9", "--stats", out="f.##.png")
        self.assertNotIn("diced again", quiet.out)
        self.assertNotIn("DICE", quiet.err)

    def test_findings_are_told_once(self):
        text = DIVING.replace("Oi = 1;", 'Oi = 1; color map = texture("nowhere.png");').replace(
            "h * N;", "h * N + 0 * log(xcomp(P) - 100) * N;")
        result = self.render(text, "--frames", "9-11", out="f.##.png")
        for code in ("FILE_MISSING", "IMAGE_UNREADABLE", "RSL_"):
            self.assertLessEqual(result.err.count(code), 1, result)

    def test_skip_existing_and_files_of_outputs_work_as_for_other_frames(self):
        words = ("--skip-existing", "--frames", "9-11", "--stats=json")
        self.render(DIVING, *words, out="f.##.png")
        stats = json.loads(self.render(DIVING, *words, out="f.##.png").out)
        self.assertEqual([frame["state"] for frame in stats["frames"]], ["kept"] * 3)
        self.assertEqual(stats["redices"], 0)
        text = DIVING.replace("surface clay()", "surface clay(output varying float height = 0;)").replace(
            "Oi = 1;", "Oi = 1; height = zcomp(P);")
        self.render(text, "--frames", "10", "--aov", "height", out="a.exr")
        self.assertIn(b"height", (self.folder / "a.exr").read_bytes()[:2000])

    def test_the_limit_of_triangles_holds_and_is_told_once(self):
        _, stats = self.frames("limit", "8-12", "--dice-limit", "900")
        self.assertLessEqual(stats["dice_triangles"], 900)
        result = self.render(DIVING, "--frames", "8-12", "--dice-limit", "900", out="f.##.png")
        self.assertEqual(result.err.count("DICE_LIMIT"), 1, result)

    def test_points_are_baked_by_such_frames_too(self):
        text = DIVING.replace("Oi = 1;", 'Oi = 1; bake3d("p.ptc", "", P, n, "h", zcomp(P));')
        self.render(text, "--frames", "10", out="f.##.png")
        self.assertGreater((self.folder / "p.ptc").stat().st_size, 1000)

    def test_scenes_without_displacement_have_none(self):
        result = self.render(MATTE.read_text(), "--frames", "1", "--stats=json", out="f.##.png")
        stats = json.loads(result.out)
        self.assertEqual((stats["redices"], stats["redice_ms"]), (0, 0))


if __name__ == "__main__":
    main()
