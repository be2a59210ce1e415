"""tests/programs/render/collapsed_test.py: surfaces that a skin or a morph takes to one point, and what is beside them.
tests/raytrace/pose_fuzz_test.cpp tries many more poses of the ray tracer alone."""
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from programs import main, render, run
from written_scenes import (CAMERA, EYE, WHITE, SceneTest, animation, animations, controllers, document, geometries,
                            mesh, morph, one_joint_skin, place, square)

IDENTITY = "1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1"
ZEROS = " ".join("0" * 16)
SETTINGS = (("--quality", ("draft", "preview", "final", "reference")), ("--bvh", ("refit", "rebuild")),
            ("--robust", ("on", "off")), ("--skin", ("linear", "dual")))
SKELETON = "<skeleton>#j</skeleton>"


def skins(count, joint, shown=0, libraries=""):
    """So many skins on one joint, `shown` of them on one that stays, and a square at the left."""
    made, nodes = [], f'<node id="j" sid="j" type="JOINT">{joint}</node><node id="k" sid="j" type="JOINT"/>'
    for i in range(count):
        made.append(one_joint_skin("square", IDENTITY).replace('"skin', f'"skin{i}').replace("#skin", f"#skin{i}"))
        skeleton = SKELETON.replace("#j", "#k") if i < shown else SKELETON
        nodes += place(url=f"#skin{i}", kind="controller", skeleton=skeleton, id=f"n{i}")
    nodes += place("<translate>-1.5 0 0</translate><scale>.25 .25 1</scale>", id="still")
    return document(CAMERA + WHITE + libraries + geometries(square()) + controllers(*made), EYE + nodes)


def morphs():
    """Two morphs whose targets are one point, at weight 1 from 1 s on."""
    flat = mesh("flat", [0.0] * 12, [0, 1, 2, 0, 2, 3])
    made, keys, nodes = [], [], ""
    for i in range(2):
        made.append(morph("square", "flat").replace('"morph', f'"morph{i}').replace("#morph", f"#morph{i}"))
        keys.append(animation(f"a{i}", f"morph{i}-w-a(0)", [0, 1], [0, 1]))
        nodes += place(url=f"#morph{i}", kind="controller", id=f"n{i}")
    return document(CAMERA + WHITE + animations(*keys) + geometries(square(), flat) + controllers(*made), EYE + nodes)


class Collapsed(SceneTest):
    STILL = (4, 4)  # pixels of the square at the left; those of a shown skin are 16 x 16

    def render(self, text, *words, **settings):
        """By the file's camera, however little it sees."""
        return super().render(text, "--camera", "eye", *words, **settings)

    def lit(self, name="a.png"):
        found = self.box(name)
        return found and found[0]

    def test_skins_scaled_to_0_leave_the_rest(self):
        hidden = '<scale>0 0 0</scale>'
        for option, values in SETTINGS:
            for value in values:
                for count in (1, 2, 8):
                    with self.subTest(option=option, value=value, count=count):
                        self.render(skins(count, hidden), option, value)
                        self.assertEqual(self.lit(), 16)

    def test_a_skin_beside_them_is_seen(self):
        self.render(skins(3, "<scale>0 0 0</scale>", shown=1))
        self.assertEqual(self.lit(), 16 * 16 + 16)

    def test_a_matrix_of_zeros_is_named(self):
        result = self.render(skins(2, f"<matrix>{ZEROS}</matrix>"))
        self.assertEqual(self.lit(), 16)
        self.assertIn("NODE_MATRIX_ZERO", result.err)
        self.assertIn("<matrix>0 0 0", result.err)

    def test_scales_that_go_to_0_and_come_back(self):
        for numbers in ([1, 0, 1], [0, 1, 0]):
            text = skins(2, '<scale sid="s">1 1 1</scale>', libraries=animations(
                animation("a", "j/s", [0, 1, 2], [n for n in numbers for _ in range(3)], width=3)))
            self.render(text, "--frames", "0-48", out="f.##.png")
            for frame in (0, 12, 24, 36, 48):
                size = numbers[0] * abs(1 - frame / 24) + numbers[1] * (1 - abs(1 - frame / 24))
                with self.subTest(numbers=numbers, frame=frame):
                    self.assertEqual(self.lit(f"f.{frame:02}.png"), round(16 * size) ** 2 + 16)

    def test_morphs_that_go_to_a_point(self):
        for option, values in SETTINGS[:3]:
            for value in values:
                with self.subTest(option=option, value=value):
                    self.render(morphs(), "--frames", "0,12,24", option, value, out="f.##.png")
                    self.assertEqual([self.lit(f"f.{f:02}.png") for f in (0, 12, 24)], [256, 64, None])

    def test_the_player_shows_them_too(self):
        scene = self.write("scene.dae", skins(2, "<scale>0 0 0</scale>"))
        self.expect(run("kinora-play", scene, "--headless", "--screenshot", self.folder / "p.png", "--camera", "eye", "--size", "32x32",
                        "--spp", "4", "--filter", "box", "--color", "legacy", "--threads", "2"), 0)
        self.assertEqual(self.lit("p.png"), 16)


if __name__ == "__main__":
    main()
