"""tests/first_look/first_look_test.py: each fault of a first picture is found, by a program that only pretends to render."""
import re
import stat
import sys
import unittest
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent / "programs")]
import corpus  # noqa: E402
import first_look  # noqa: E402
import shapes  # noqa: E402
from programs import ProgramTest, main  # noqa: E402

SIZE = 40
# Writes the picture called plain.png or grey.png beside it, says what said.txt says, ends as code.txt says.
PRETENDER = """#!/bin/sh
here=$(dirname "$0") picture=plain.png
for word; do
    [ "$before" = -o ] && output=$word
    [ "$word" = --shader ] && picture=grey.png
    before=$word
done
[ -e "$here/$picture" ] && cp "$here/$picture" "$output"
cat "$here/said.txt" >&2
exit "$(cat "$here/code.txt")"
"""


class Faults(ProgramTest):
    def setUp(self):
        super().setUp()
        self.folder = self.folder / "project" / "models"  # pictures are looked for in the parent folder, too
        self.folder.mkdir(parents=True)
        self.program = self.write("pretender", PRETENDER)
        self.program.chmod(self.program.stat().st_mode | stat.S_IXUSR)
        self.scene = self.write("scene.dae", "<COLLADA><init_from>a%20wall.png</init_from></COLLADA>")
        self.write("A Wall.PNG", "")

    def fault(self, plain=None, grey=lambda x, y: (128, 128, 128, 255), code=0, said="", **expected):
        for name, pixel in (("plain.png", plain), ("grey.png", grey)):
            (self.folder / name).unlink(missing_ok=True)
            if pixel:
                shapes.png(self.folder / name, SIZE, SIZE, pixel, 4)
        self.write("said.txt", said)
        self.write("code.txt", str(code))
        pictures = self.folder / "pictures"
        pictures.mkdir(exist_ok=True)
        return first_look.look(
            {
                "place": 0,
                "group": "a",
                "name": "scene.dae",
                "file": self.scene,
                "folder": pictures,
                "program": self.program,
                "scale": "1",
                "spp": 1,
                "expected": expected,
            }
        )["fault"]

    @staticmethod
    def part(share, colour):
        """A picture whose first pixels, this share of them, have a colour; the rest is mid grey."""
        return lambda x, y: (*(colour if y * SIZE + x < share * SIZE * SIZE else (120, 120, 120)), 255)

    @staticmethod
    def covered(pixels):
        return lambda x, y: (120, 120, 120, 255 if y * SIZE + x < pixels else 0)

    def test_nothing_is_found_in_a_plain_picture(self):
        self.assertEqual(self.fault(self.covered(SIZE * SIZE)), "")

    def test_codes_other_than_0(self):
        self.assertEqual(self.fault(self.covered(500), code=1), "exit")
        self.assertEqual(self.fault(self.covered(500), code=3), "exit")

    def test_blank_and_speck(self):
        self.assertEqual(self.fault(self.covered(3)), "blank")  # 3 of 1600 is under 0.2 %
        self.assertEqual(self.fault(self.covered(4)), "speck")
        self.assertEqual(self.fault(self.covered(47)), "speck")  # 48 of 1600 is 3 %
        self.assertEqual(self.fault(self.covered(48)), "")

    def test_holes(self):
        self.assertEqual(self.fault(self.covered(400), least=0.25), "")
        self.assertEqual(self.fault(self.covered(399), least=0.25), "holes")

    def test_colour(self):
        self.assertEqual(self.fault(self.part(1, (140, 90, 100)), warmth=1.4), "")
        self.assertEqual(self.fault(self.part(1, (138, 90, 100)), warmth=1.4), "colour")

    def test_white(self):
        self.assertEqual(self.fault(self.part(0.6, (255, 255, 255))), "")
        self.assertEqual(self.fault(self.part(0.65, (255, 255, 255))), "white")
        self.assertEqual(self.fault(self.part(0.65, (255, 255, 200))), "")

    def test_checks_where_the_image_exists(self):
        for magenta in ((255, 0, 255), (120, 4, 120), (208, 60, 208), (66, 0, 62)):
            self.assertEqual(self.fault(self.part(0.02, magenta)), "")
            self.assertEqual(self.fault(self.part(0.05, magenta)), "checks")
        for violet in ((94, 58, 101), (149, 76, 148), (208, 144, 208), (120, 0, 160)):
            self.assertEqual(self.fault(self.part(0.5, violet)), "")
        self.assertEqual(self.fault(self.part(0.05, (200, 60, 40))), "")
        self.assertEqual(self.fault(self.part(0.05, (80, 95, 160))), "")
        (self.folder / "A Wall.PNG").unlink()
        self.assertEqual(self.fault(self.part(0.05, (255, 0, 255))), "")

    def test_black_under_a_grey_matte(self):
        grey = self.covered(1600)
        self.assertEqual(self.fault(grey, self.part(0.3, (42, 42, 42))), "")
        self.assertEqual(self.fault(grey, self.part(0.35, (42, 42, 42))), "black")
        self.assertEqual(self.fault(grey, self.part(0.35, (43, 43, 43))), "")
        self.assertEqual(self.fault(self.part(1, (7, 7, 7))), "black")
        self.assertEqual(self.fault(self.part(0.9, (7, 7, 7))), "")

    def test_what_must_be_said(self):
        dark = self.part(1, (5, 5, 5))
        self.assertEqual(self.fault(dark, dark, told="--lights both"), "silent")
        self.assertEqual(self.fault(dark, dark, said="try --lights both", told="--lights both"), "")
        self.assertEqual(self.fault(self.covered(3), said="try --lights both", told="--lights both"), "blank")

    def test_nothing_to_draw(self):
        self.assertEqual(self.fault(code=3, said="[SCENE_EMPTY]", nothing=True), "")
        self.assertEqual(self.fault(code=3, nothing=True), "silent")
        self.assertEqual(self.fault(self.covered(1600), nothing=True), "exit")

    def test_what_is_refused(self):
        self.assertEqual(self.fault(code=3, said="COLLADA 1.3 is not read", refused="1.3 is not read"), "")
        self.assertEqual(self.fault(code=3, said="nothing to see", refused="1.3 is not read"), "silent")
        self.assertEqual(self.fault(self.covered(1600), said="1.3 is not read", refused="1.3 is not read"), "exit")

    def test_a_picture_is_read(self):
        shapes.png(self.folder / "a.png", 3, 2, lambda x, y: (x, y, 7, 100 + x), 4)
        self.assertEqual(
            first_look.pixels(self.folder / "a.png"),
            (
                3,
                2,
                [
                    bytes((0, 0, 7, 100, 1, 0, 7, 101, 2, 0, 7, 102)),
                    bytes((0, 1, 7, 100, 1, 1, 7, 101, 2, 1, 7, 102)),
                ],
            ),
        )


class Corpus(ProgramTest):
    def test_has_the_files_it_says(self):
        expected = corpus.write(self.folder / "corpus")
        self.assertGreaterEqual(len(expected), 80)
        self.assertEqual(len(expected), len(corpus.CORPUS))
        for name, wanted in expected.items():
            if not name.endswith(".dae"):
                continue
            text = (self.folder / "corpus" / name).read_text()
            faces = len(re.findall(r"<(?:triangles|polylist|polygons|trifans|instance_geometry url=\"parts)", text))
            with self.subTest(name):
                self.assertLessEqual(set(wanted), {"nothing", "told", "missing", "least", "warmth"})
                if not wanted.get("nothing"):
                    self.assertGreater(faces, 0)
                named = "<init_from>" in text and re.search(r"<init_from>[^<]*\.\w+<", text)
                if named and not wanted.get("missing"):
                    self.assertTrue(
                        first_look.pictures_of(self.folder / "corpus" / name), "no picture of it is written"
                    )

    def test_models_are_no_single_triangles(self):
        for name in ("chair", "house", "car", "person", "robot_arm", "dog", "tower", "gear", "tree"):
            self.assertGreater(len(getattr(shapes, name)().faces), 40, name)

    def test_ten_were_written_blind(self):
        self.assertEqual(len(first_look.documents(HERE / "blind")), 10)


if __name__ == "__main__":
    main()
