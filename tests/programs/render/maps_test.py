"""tests/programs/render/maps_test.py: maps that a RIB file makes of its own earlier pictures, which are rendered for
them and not written."""
import struct
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from programs import ProgramTest, main, render

PICTURE = 'Format 32 32 1\nPixelSamples 1 1\nPixelFilter "box" 1 1\n'
LEFT, RIGHT = ('Polygon "P" [-1 -1 3 0 -1 3 0 1 3 -1 1 3]', 'Polygon "P" [0 -1 3 1 -1 3 1 1 3 0 1 3]')
LOW, ALL = ('Polygon "P" [-1 -1 2 1 -1 2 1 0 2 -1 0 2]',
            'Polygon "P" [-1 -1 3 1 -1 3 1 1 3 -1 1 3] "st" [0 1 1 1 1 0 0 0]')
PAINT = 'surface paint(string name = "";) { Oi = 1; Ci = texture(name, s, t, "filter", "nearest"); }'
SKY = ('surface sky(string name = "";) { Oi = 1; '
       'Ci = environment(name, vtransform("world", vector(2 * s - 1, 1 - 2 * t, 1)), "filter", "box"); }')


def constant(color, shape):
    return f'Surface "constant" Color {color} {shape}\n'


def looked_up(name, shader="paint"):
    return f'Surface "{shader}" "string name" "{name}" {ALL}\n'


def made(name):
    return f'MakeTexture "{name}.tif" "{name}.tx" "clamp" "clamp" "box" 1 1\n'


def world(frame, display, inside):
    return f'FrameBegin {frame}\nDisplay "{display}.tif" "file" "rgb"\nWorldBegin\n{inside}WorldEnd\nFrameEnd\n'


FIRST = constant("0 1 0", LEFT) + constant("0 0 1", RIGHT)
SECOND = looked_up("a.tx") + constant("1 0 0", LOW)
CHAIN = (PICTURE + world(1, "a", FIRST) + made("a") + world(2, "b", SECOND) + made("b") +
         world(3, "aside", looked_up("not_there.png")) + made("aside") + world(4, "c", looked_up("b.tx")))


def pixels(picture):
    """The packed pixels of a PNG, without what it says of its scene."""
    at, found = 8, b""
    while at < len(picture):
        length, kind = struct.unpack(">I4s", picture[at:at + 8])
        found += picture[at + 8:at + 8 + length] if kind == b"IDAT" else b""
        at += 12 + length
    return found


class Maps(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("paint.sl", PAINT)
        self.write("sky.sl", SKY)

    def picture(self, text, name="p.png", *words, says=""):
        scene = self.write("scene.rib", text)
        self.expect(render(scene, "-o", self.folder / name, "--progress", "none", *words), 0, says)
        return (self.folder / name).read_bytes()

    def by_hand(self, *steps):
        """The last of pictures that are made one by one, through files."""
        names = [name for name, text in steps]
        made = [self.picture(PICTURE + text, name) for name, text in steps]
        for name in names:
            (self.folder / name).unlink()
        return pixels(made[-1])

    def test_a_picture_sees_maps_of_those_before_it(self):
        wanted = self.by_hand(("a.png", world(1, "a", FIRST)), ("b.png", made("a") + world(2, "b", SECOND)),
                              ("p.png", made("b") + world(4, "c", looked_up("b.tx"))))
        self.assertEqual(pixels(self.picture(CHAIN)), wanted)
        self.assertEqual(sorted(path.name for path in self.folder.iterdir()),
                         ["p.png", "paint.sl", "scene.rib", "sky.sl"])

    def test_it_is_the_same_in_the_film(self):
        scene = self.write("scene.rib", CHAIN)
        self.expect(render(scene, "-o", self.folder / "all/f.####.png"), 0)
        self.expect(render(scene, "-o", self.folder / "one/f.####.png", "--frames", "4"), 0)
        self.assertEqual((self.folder / "all/f.0004.png").read_bytes(), (self.folder / "one/f.0004.png").read_bytes())

    def test_a_map_stays_what_it_was_made_of(self):
        """A later picture has a display of the same name, of which no map is made."""
        wanted = self.by_hand(("a.png", world(1, "a", FIRST)), ("p.png", made("a") + world(3, "c", looked_up("a.tx"))))
        outside = 'Surface "paint" "string name" "a.tx"\n'
        scene = self.write("scene.rib", PICTURE + world(1, "a", FIRST) + made("a") + outside +
                           world(2, "a", f"{ALL}\n" + constant("1 0 0", LOW)) + world(3, "c", ALL))
        self.expect(render(scene, "-o", self.folder / "f.####.png"), 0)
        self.assertEqual(pixels((self.folder / "f.0003.png").read_bytes()), wanted)
        self.expect(render(scene, "-o", self.folder / "p.png"), 0)
        self.assertEqual(pixels((self.folder / "p.png").read_bytes()), wanted)

    def test_passes_of_one_frame_are_told(self):
        passes = world(1, "a", FIRST) + world(1, "b", constant("1 0 0", LOW))
        scene = self.write("scene.rib", PICTURE + passes)
        said = render(scene, "-o", self.folder / "f.####.png")
        self.expect(said, 0, "FRAME_PASSES", "frame 1 has 2 pictures")
        self.assertEqual(said.err.count("FRAME_PASSES"), 1)
        last = self.write("last.rib", PICTURE + world(1, "b", constant("1 0 0", LOW)))
        self.assertNotIn("FRAME_PASSES", render(last, "-o", self.folder / "last.png").err)
        self.assertEqual(pixels((self.folder / "f.0001.png").read_bytes()),
                         pixels((self.folder / "last.png").read_bytes()))

    def test_the_view_of_the_command_line_is_not_that_of_maps(self):
        self.picture(CHAIN, "p.png", "--size", "8x64", "--exposure", "1")
        scene = self.write("scene.rib", CHAIN)
        words = ("--size", "8x64", "--exposure", "1")
        self.expect(render(scene, "-o", self.folder / "f.####.png", *words), 0)
        self.assertEqual((self.folder / "f.0004.png").read_bytes(), (self.folder / "p.png").read_bytes())

    def test_maps_that_nobody_looks_up_are_not_made(self):
        said = render(self.write("scene.rib", CHAIN), "-o", self.folder / "p.png").err
        self.assertNotIn("IMAGE_UNREADABLE", said)

    def test_a_file_of_the_name_is_not_the_map(self):
        wanted = pixels(self.picture(CHAIN))
        self.picture(PICTURE + world(1, "x", constant("1 1 1", ALL)), "b.png")
        self.assertEqual(pixels(self.picture(CHAIN)), wanted)

    def test_the_six_faces_of_a_cube(self):
        faces = [f"face{k}" for k in range(6)]
        worlds = "".join(world(k, name, constant(f"{k / 5} .5 0", LEFT))
                         for k, name in enumerate(faces))
        cube = "MakeCubeFaceEnvironment " + " ".join(f'"{name}.tif"' for name in faces) + ' "m.env" 90 "box" 1 1\n'
        last = cube + world(9, "c", looked_up("m.env", "sky"))
        wanted = self.by_hand(*((f"{name}.png", world(1, name, constant(f"{k / 5} .5 0", LEFT)))
                                for k, name in enumerate(faces)), ("p.png", last))
        self.assertEqual(pixels(self.picture(PICTURE + worlds + last)), wanted)

    def test_a_change_of_a_map_is_a_change_of_what_shows_it(self):
        chain = self.write("chain.rib", CHAIN.replace(SECOND, looked_up("c.png")))
        words = (chain, "-o", self.folder / "shown.png", "--skip-existing")
        shown = []
        for color in ("1 0 0", "0 1 0"):
            self.picture(PICTURE + world(1, "c", constant(color, ALL)), "c.png")
            self.expect(render(*words), 0)
            self.assertIn("kept", render(*words).err)
            shown.append(pixels((self.folder / "shown.png").read_bytes()))
        self.assertNotEqual(*shown)


if __name__ == "__main__":
    main()
