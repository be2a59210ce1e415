"""tests/programs/attach_test.py: the examples of docs/attach.md are whole, valid, and do what they say."""
import importlib.machinery
import importlib.util
import sys

from programs import SOURCE, ProgramTest, main, render, run

sys.path.insert(0, str(SOURCE / "scripts"))
from sheet import png  # noqa: E402

SCRIPT = str(SOURCE / "scripts/attach_examples")
loader = importlib.machinery.SourceFileLoader("attach_examples", SCRIPT)
attach = importlib.util.module_from_spec(importlib.util.spec_from_loader("attach_examples", loader))
loader.exec_module(attach)

WIDTH, HEIGHT = 60, 40
BALL, FLOOR = (28, 19), (20, 37)          # pixels in the middle of the ball and on the floor before it
STAGES = ("surface", "co-shaders", "displacement", "transformation", "light", "light-on-geometry", "volume", "atmosphere", "imager")


class Examples(ProgramTest):
    @classmethod
    def setUpClass(cls):
        cls.documents = attach.examples()

    def picture(self, stage, *words):
        scene = self.write(f"{stage}.dae", self.documents[stage])
        out = self.folder / f"{stage}.png"
        self.expect(render(scene, "-o", out, "--size", f"{WIDTH}x{HEIGHT}", "--spp", "16", "--threads", "2", *words), 0)
        return png.read(out)[2]

    def at(self, rows, pixel):
        x, y = pixel
        return tuple(rows[y][3 * x:3 * x + 3])

    def changed(self, stage):
        """Pixels of the example that are not those of the scene without it."""
        plain, with_it = self.picture("none"), self.picture(stage)
        return {(x, y) for y in range(HEIGHT) for x in range(WIDTH)
                if max(abs(a - b) for a, b in zip(self.at(plain, (x, y)), self.at(with_it, (x, y)))) > 2}

    def test_each_stage_has_its_section_and_its_picture(self):
        self.assertEqual(tuple(self.documents), ("none", *STAGES))
        page = (SOURCE / "docs/attach.md").read_text()
        for stage in self.documents:
            self.assertIn(f"(images/attach-{stage}.png)", page)
            self.assertTrue((SOURCE / f"docs/images/attach-{stage}.png").exists())

    def test_all_are_valid(self):
        for stage, text in self.documents.items():
            with self.subTest(stage=stage):
                self.expect(run("kinora-validate", "--fail-on", "warning", self.write(f"{stage}.dae", text)), 0)

    def test_surface_and_displacement_change_the_ball_alone(self):
        posts = {(x, y) for x in range(48, WIDTH) for y in range(HEIGHT)}
        for stage in ("surface", "co-shaders", "displacement", "transformation", "volume"):
            changed = self.changed(stage)
            self.assertIn(BALL, changed, stage)
            self.assertFalse(changed & posts, stage)

    def test_displacement_moves_the_outline_and_surface_does_not(self):
        # The ball before black: what is lit there is the ball.
        def outline(stage):
            rows = self.picture(stage, "--only", "ball")
            return sum(max(self.at(rows, (x, y))) > 10 for x in range(WIDTH) for y in range(HEIGHT))
        plain = outline("none")
        self.assertLess(abs(outline("surface") - plain), 0.02 * plain)
        self.assertGreater(outline("displacement"), 1.05 * plain)
        self.assertLess(outline("transformation"), 0.8 * plain)

    def test_the_light_has_stripes_on_the_floor(self):
        # Up the floor's column of pixels the light goes off and on, which it does not without slats.
        def turns(stage):
            column = [self.at(self.picture_rows[stage], (12, y))[0] for y in range(26, HEIGHT)]
            steps = [b - a for a, b in zip(column, column[1:]) if abs(b - a) > 8]
            return sum(a * b < 0 for a, b in zip(steps, steps[1:]))
        self.picture_rows = {stage: self.picture(stage) for stage in ("none", "light")}
        self.assertGreater(turns("light"), turns("none"))

    def test_the_panel_lights_the_floor_beside_it(self):
        plain, lit = (self.at(self.picture(stage), (6, 34)) for stage in ("none", "light-on-geometry"))
        self.assertGreater(lit[0], plain[0] + 10)
        self.assertGreater(lit[0] - plain[0], lit[2] - plain[2])  # orange

    def test_mist_hides_more_of_what_is_far(self):
        # The sky, infinitely far, becomes the mist's own colour; near the floor less is hidden.
        mist, plain = self.picture("atmosphere"), self.picture("none")
        def moved(pixel):
            return max(abs(a - b) for a, b in zip(self.at(mist, pixel), self.at(plain, pixel)))
        self.assertGreater(moved((30, 2)), 2 * moved(FLOOR))

    def test_the_imager_reaches_every_pixel_with_something_in_it(self):
        rows = self.picture("imager")
        for pixel in (BALL, FLOOR):
            r, g, b = self.at(rows, pixel)
            self.assertTrue(r <= g <= b or r >= g >= b, (r, g, b))  # between the two inks


if __name__ == "__main__":
    main()
