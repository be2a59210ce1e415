"""tests/programs/render/render_same_bytes_test.py: a frame is the same file however it was made."""
import unittest
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from programs import SCENES, ProgramTest, main, render, supported_targets

SMALL = ("--size", "64x36", "--spp", "2", "--math", "precise", "-q")


class SameBytes(ProgramTest):
    def frames(self, scene, name, *words):
        folder = self.folder / name
        result = render(scene, "-o", folder / "f.###.exr", "--frames", "0,7", *SMALL, *words)
        self.expect(result, 0)
        return self.pictures(folder)

    def check_scene(self, name):
        scene = SCENES / name
        if not scene.exists():
            self.skipTest(f"{name} is not made yet")
        wanted = self.frames(scene, "one", "--threads", "1")
        self.assertEqual(len(wanted), 2)
        self.assertTrue(wanted == self.frames(scene, "two", "--threads", "2"), "threads")
        self.assertTrue(wanted == self.frames(scene, "again", "--threads", "2"), "a second run")
        for target in supported_targets():
            with self.subTest(target=target):
                self.assertTrue(wanted == self.frames(scene, target, "--target", target), target)

    def test_matte(self):
        self.check_scene("matte.dae")

    def test_tintoy(self):
        self.check_scene("tintoy.dae")

    def test_walker(self):
        self.check_scene("walker.dae")


class AllTargets(unittest.TestCase):
    def test_the_interpreter_always_runs(self):
        self.assertIn("interp", supported_targets())


if __name__ == "__main__":
    main()
