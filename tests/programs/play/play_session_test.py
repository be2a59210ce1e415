"""tests/programs/play/play_session_test.py: sessions: what kinora-play saves, kinora-render makes the same picture of."""
import json
import shutil
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from programs import MATTE, SCENES, SHADERS, SOURCE, ProgramTest, main, render, run

sys.path.insert(0, str(SOURCE / "scripts/sheet"))
import png  # noqa: E402

SMALL = ("--size", "64x36", "--spp", "2", "--threads", "2")
LOOK = """orbit 20 8
follow statue
seek 7.25
select_material wall-material
edit
find "value * (Ka"
type "color(1, 0, 1) * "
param Kd 0.4
exposure 0.5
size 60 40
hide knot
loop pingpong
tone filmic
tone plain
"""


class Sessions(ProgramTest):
    def save(self, scene, look, *words):
        """Pixels of the refined picture, and the session."""
        session, shot = self.folder / "a.kinora", self.folder / "a.png"
        script = self.write("a.txt", f"{look}\nsave_session {session}\nscreenshot {shot}\nscreenshot {self.folder / 'a.exr'}\n")
        self.expect(run("kinora-play", scene, "--headless", "--script", script, *SMALL, *words), 0)
        return png.read(shot), session

    def rendered(self, *words):
        file = self.folder / "b.png"
        self.expect(render(*words, "-o", file, "--threads", "2"), 0)
        return png.read(file)

    def check(self, scene, look, *words):
        pixels, session = self.save(scene, look, *words)
        self.assertEqual(self.rendered("--session", session), pixels)
        return pixels, session

    def test_the_picture_is_the_same(self):
        pixels, session = self.check(SCENES / "walker.dae", LOOK, "--lights", "both", "--seed", "3")
        self.assertEqual(pixels[:2], (60, 40))
        again = self.folder / "c.exr"
        self.expect(run("kinora-play", session, "--headless", "--screenshot", again, "--threads", "1"), 0)
        self.assertEqual(again.read_bytes(), (self.folder / "a.exr").read_bytes())
        stored = json.loads(session.read_text())
        self.assertEqual(stored["frame"], 7.25)
        self.assertIn("loop pingpong", stored["commands"])
        self.assertEqual(stored["panels"], ["editor"])

    def test_of_other_scenes(self):
        self.check(SOURCE / "assets/gltf/bender.glb", "clip KeyAction\norbit 40 10\nparallel\nseek 9", "--exposure", "1")
        self.check(SCENES / "tintoy.dae", "seek 11\norbit 3 3", "--background", "0.1,0.2,0.3")
        self.check(MATTE, "orbit 2 0", "--camera", "top", "--shader", f"bright={SHADERS / 'plastic.sl'}", "--param", "bright.Ks=0.9")

    def test_it_moves_with_its_scene(self):
        tree = self.folder / "tree"
        tree.mkdir()
        shutil.copy(MATTE, tree / "scene.dae")
        _, session = self.save(tree / "scene.dae", "orbit 5 5")
        session = session.rename(tree / "a.kinora")  # it lies beside its scene
        session.write_text(session.read_text().replace('"tree/scene.dae"', '"scene.dae"'))
        before = self.rendered(session)
        tree = tree.rename(self.folder / "other")
        self.assertEqual(self.rendered(tree / "a.kinora"), before)

    def test_the_command_line_is_stronger(self):
        _, session = self.save(SCENES / "walker.dae", LOOK)
        self.assertEqual(self.rendered("--session", session, "--size", "32x18")[:2], (32, 18))
        frames = self.folder / "f.##.png"
        self.expect(render("--session", session, "--frames", "3-4", "--size", "16x9", "-o", frames), 0)
        self.assertEqual(len([name for name in self.pictures() if name.startswith("f.")]), 2)
        self.assertNotEqual(self.rendered(session, "--param", "marble-material.Kd=0"), self.rendered(session))

    def test_what_is_no_session(self):
        for text, said in (("{", ":1:"), ("[]", "is no object"), ("{}", "kinora_session is missing"),
                           ('{"kinora_session": 7}', "reads 1"), ('{"kinora_session": 1, "scene": 3}', "scene is no text")):
            file = self.write("bad.kinora", text)
            self.expect(render("--session", file, "-o", "null"), 3, said, "bad.kinora")
            self.expect(run("kinora-play", file, "--headless", "--screenshot", self.folder / "a.png"), 3, said)
        self.expect(render("--session", self.folder / "none.kinora", "-o", "null"), 3, "No such file")
        _, session = self.save(MATTE, "orbit 1 1")
        broken = json.loads(session.read_text())
        broken["camera"]["own"]["distance"] = "far"
        file = self.write("bad.kinora", json.dumps(broken))
        self.expect(render(file, "-o", "null"), 3, "camera.own.distance is no number")
        broken["camera"]["own"]["distance"] = 1
        broken["options"] = ["--quality=nosuch"]
        self.expect(render(self.write("bad.kinora", json.dumps(broken)), "-o", "null"), 2, "nosuch")

    def test_a_comparison_is_kept(self):
        """The left of the wipe is a picture of other settings, another shader and another time."""
        pixels, session = self.save(SCENES / "walker.dae", "select_material wall-material\nparam Kd 0.1\nexposure 1\nseek 3\nkeep\n"
                                    "undo\nexposure 0\nseek 9\nwipe 0.25\n")
        shot = self.folder / "e.png"
        self.expect(run("kinora-play", session, "--headless", "--screenshot", shot, "--threads", "2"), 0)
        self.assertEqual(png.read(shot), pixels)
        plain = self.rendered(session)  # kinora-render shows no comparison
        self.assertEqual(pixels[:2], (64, 36))

        def columns(picture, first, last):
            return [row[3 * first:3 * last] for row in picture[2]]
        self.assertEqual(columns(pixels, 16, 64), columns(plain, 16, 64))
        self.assertNotEqual(columns(pixels, 0, 16), columns(plain, 0, 16))
        script = self.write("f.txt", f"open {session}\nwait refined\nkeep\nscreenshot {shot}\n")  # no longer
        self.expect(run("kinora-play", MATTE, "--headless", "--script", script, *SMALL), 0)
        self.assertEqual(png.read(shot)[2], plain[2])
        broken = json.loads(session.read_text())
        broken["kept"]["picture"] = broken["kept"]["picture"][:400]
        self.expect(run("kinora-play", self.write("bad.kinora", json.dumps(broken)), "--headless", "--screenshot", shot), 3,
                    "kept.picture is no PNG")

    def test_it_is_opened_by_a_script(self):
        pixels, session = self.save(SCENES / "walker.dae", LOOK)
        shot = self.folder / "d.png"
        script = self.write("d.txt", f"orbit 9 9\nopen {session}\nwait refined\nexpect time 7.25\nscreenshot {shot}\n")
        self.expect(run("kinora-play", MATTE, "--headless", "--script", script, *SMALL), 0)
        self.assertEqual(png.read(shot), pixels)


if __name__ == "__main__":
    main()
