"""tests/programs/render/render_camera_test.py: cameras that kinora-render adds: its options, frames that shards
and resumed runs agree on; files with nothing to draw; a contact sheet of frames that were kept; a full disk."""
import json
import shutil
import subprocess
import unittest
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from programs import MATTE, ProgramTest, command, main, render
from written_scenes import (CAMERA, EYE, WHITE, animation, animations, document, geometries, mesh, place, square)

SMALL = ("--size", "32x18", "--spp", "1", "--threads", "2", "--progress", "none")
MOVING = document(WHITE + geometries(square()) + animations(animation("a", "node/t.X", [0, 1], [0, 9])),
                  place('<translate sid="t">0 0 0</translate>'))


class Cameras(ProgramTest):
    def setUp(self):
        super().setUp()
        self.scene = self.write("scene.dae", MOVING)

    def frames(self, folder, *words):
        out = self.folder / folder / "f.####.png"
        self.expect(render(self.scene, "-o", out, *SMALL, *words), 0)
        return self.pictures(self.folder / folder)

    def test_what_makes_no_sense_is_refused(self):
        out = ("-o", self.folder / "a.png", "--frames", "1", *SMALL)
        for words, text in ((("--camera", "eye", "--turntable", "8"), "not 'eye'"),
                            (("--camera", "eye", "--camera-follow"), "leave --camera out"),
                            (("--camera", "front", "--look-from", "1,2,3"), "--look-from"),
                            (("--look-from", "1,2"), "takes X,Y,Z"),
                            (("--look-from", "1,2,nan"), "takes X,Y,Z"),
                            (("--look-from", "1,2,3", "--look-at", "1,2,3.0"), "is where --look-from is"),
                            (("--fov", "180"), "takes 0.01 to 170"), (("--turntable", "0"), "--turntable"),
                            (("--look-at", "nobody"), "no node matches 'nobody'"),
                            (("--camera", "frnt"), "no camera 'frnt'")):
            with self.subTest(words=words):
                self.expect(render(self.scene, *out, *words), 2, text)

    def test_shards_and_the_whole_agree(self):
        for words in (("--camera", "auto"), ("--camera-follow",), ("--turntable", "5"),
                      ("--look-from", "3,4,15", "--look-at", "node")):
            with self.subTest(words=words):
                name = words[0].strip("-")
                whole = self.frames(f"whole {name}", "--frames", "0-24x6", *words)
                self.assertEqual(len(set(whole.values())), 5)
                shard = self.frames(f"shard {name}", "--frames", "18", *words)
                self.assertEqual(shard["f.0018.png"], whole["f.0018.png"])

    def test_a_turntable_has_its_own_frames(self):
        self.scene = self.write("still.dae", document(WHITE + geometries(square()), place()))
        pictures = self.frames("turn", "--turntable", "6")
        self.assertEqual(list(pictures), [f"f.{n:04}.png" for n in range(6)])
        self.assertEqual(len(set(pictures.values())), 6)
        again = self.frames("again", "--turntable", "6", "--frames", "6,3")
        pixels = lambda data: data[data.index(b"IDAT"):]
        self.assertEqual(pixels(again["f.0003.png"]), pixels(pictures["f.0003.png"]))
        few = self.expect(render(self.scene, "-o", self.folder / "a.png", *SMALL, "--turntable", "6"), 2)
        self.assertIn("frame token", few.err)

    def test_skip_existing_heeds_the_camera(self):
        words = ("--frames", "1", "--skip-existing")
        file = self.folder / "o/f.0001.png"
        def stamp(*more):
            self.frames("o", *words, *more)
            return file.stat().st_mtime_ns
        seen = []
        for more in ((), ("--camera", "front"), ("--camera", "auto"), ("--camera-follow",), ("--fov", "40"),
                     ("--turntable", "9"), ("--turntable", "8"), ("--look-from", "1,2,30"),
                     ("--look-from", "1,2,31"), ("--look-from", "1,2,31", "--look-at", "0,0,1"),
                     ("--look-at", "node")):
            seen.append(stamp(*more))
            self.assertEqual(stamp(*more), seen[-1], more)
        self.assertEqual(len(set(seen)), len(seen))

    def test_a_camera_that_sees_little_gives_way_and_says_how_to_be_kept(self):
        far = self.write("far.dae", document(CAMERA + WHITE + geometries(square(half=0.2)), EYE + place()))
        said = render(far, "-o", self.folder / "a.png", *SMALL)
        self.expect(said, 0, "CAMERA_SEES_LITTLE", "--camera 'eye'")
        kept = render(far, "-o", self.folder / "b.png", *SMALL, "--camera", "eye")
        self.assertNotIn("CAMERA_SEES_LITTLE", self.expect(kept, 0).err)
        pictures = self.pictures()
        self.assertNotEqual(pictures["a.png"], pictures["b.png"])
        chosen = [c["name"] for c in json.loads(render(far, "--list", "cameras", "--json").out)["cameras"]
                  if c["chosen"]]
        self.assertEqual(chosen, ["default camera"])


class Nothing(ProgramTest):
    def test_a_file_with_nothing_to_draw_is_exit_3(self):
        flat = mesh("square", [0, 0, 0, 1, 1, 1, 2, 2, 2], [0, 1, 2])
        files = {"no mesh": document(CAMERA, EYE), "no camera": document("", "<node/>"),
                 "no triangle": document(CAMERA + WHITE + geometries(square()), EYE),
                 "no area": document(CAMERA + WHITE + geometries(flat), EYE + place()),
                 "no size": document(CAMERA + WHITE + geometries(square()), EYE + place("<scale>0 0 0</scale>")),
                 "no scene": document(CAMERA + WHITE + geometries(square()), "")}
        for name, text in files.items():
            for words in (("-o", self.folder / "a.png", *SMALL), ("--list",),
                          ("-o", self.folder / "a.png", *SMALL, "--camera", "auto")):
                with self.subTest(name=name, words=words[0]):
                    self.expect(render(self.write("a.dae", text), *words), 3, "SCENE_EMPTY")
        gltf = self.write("a.gltf", '{"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"nodes":[{"name":"n"}]}')
        self.expect(render(gltf, "-o", self.folder / "a.png", *SMALL), 3, "SCENE_EMPTY")

    def test_what_the_user_hides_is_no_error(self):
        words = ("-o", self.folder / "a.png", *SMALL, "--frames", "1")
        self.expect(render(MATTE, *words, "--hide", "*"), 0, "SCENE_HIDDEN")


class Sheets(ProgramTest):
    def test_a_contact_sheet_shows_frames_that_were_kept(self):
        for kind in ("png", "exr"):
            words = (MATTE, "-o", self.folder / f"f.##.{kind}", "--frames", "1-6", *SMALL)
            sheet = ("--contact-sheet", self.folder / f"{kind}.png")
            self.expect(render(*words, *sheet), 0)
            whole = (self.folder / f"{kind}.png").read_bytes()
            (self.folder / f"f.03.{kind}").unlink()
            told = self.expect(render(*words[:-2], "--progress", "lines", *sheet, "--skip-existing"), 0)
            self.assertEqual(told.err.count("kept"), 5, told)
            size = lambda data: data[16:24]  # of the PNG's header
            again = (self.folder / f"{kind}.png").read_bytes()
            self.assertEqual(size(again), size(whole))
            if kind == "png":
                self.assertEqual(again, whole)

    def test_keep_going_on_a_full_disk_is_worth_a_retry(self):
        disk = self.folder / "disk"
        disk.mkdir()
        if not shutil.which("unshare"):
            raise unittest.SkipTest("no unshare")
        mount = f"mount -t tmpfs -o size=16k none '{disk}' && head -c 12288 /dev/zero > '{disk}/filled' && "
        probe = subprocess.run(["unshare", "-rm", "sh", "-c", mount + "true"], capture_output=True)
        if probe.returncode:
            raise unittest.SkipTest("no file system can be mounted")
        words = command("kinora-render", MATTE, "-o", disk / "f.####.exr", "--frames", "1-4", "--size",
                        "64x48", "--spp", "1", "--progress", "none", "--keep-going")
        quoted = " ".join(f"'{word}'" for word in words)
        done = subprocess.run(["unshare", "-rm", "sh", "-c", mount + quoted], capture_output=True, text=True,
                              timeout=60)
        self.assertEqual(done.returncode, 75, done.stderr)
        self.assertIn("No space left on device", done.stderr)


if __name__ == "__main__":
    main()
