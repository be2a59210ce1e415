"""tests/programs/render/films_test.py: RIB files of several frames: one process makes the pictures of many, reads the
file once, and keeps what stands."""
import json
import math
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from programs import ProgramTest, main, render

FRAMES = 4


def ground(n=40):
    """A bumpy mesh of 2 n^2 triangles."""
    points = [f"{4 * i / n - 2:.4f} {.2 * math.sin(i) * math.cos(j):.4f} {4 * j / n - 2:.4f}"
              for j in range(n + 1) for i in range(n + 1)]
    faces = [f"{a} {a + 1} {a + n + 2} {a + n + 1}"
             for j in range(n) for i in range(n) for a in [j * (n + 1) + i]]
    return f'PointsPolygons [{" 4" * (n * n)}] [{" ".join(faces)}] "P" [{" ".join(points)}]'


def film(surface="matte", beside=lambda frame: ""):
    frames = [f"""FrameBegin {f}
Display "x{f}.tif" "file" "rgb"
{beside(f)}
Projection "perspective" "fov" 40
Translate 0 0 {7 + .2 * f}
Rotate -30 1 0 0
WorldBegin
LightSource "distantlight" 1 "to" [1 -1 1]
Surface "{surface}"
ObjectInstance 1
AttributeBegin
Color 1 .2 .1
Translate {.3 * f} .6 0
Sphere .4 -.4 .4 360
AttributeEnd
WorldEnd
FrameEnd
""" for f in range(1, FRAMES + 1)]
    return ("Format 64 48 1\nPixelSamples 2 2\nObjectBegin 1\n" + ground() + "\nObjectEnd\n" + "".join(frames))


class Films(ProgramTest):
    def test_one_process_makes_the_pictures_of_many(self):
        scene = self.write("film.rib", film())
        self.expect(render(scene, "-o", self.folder / "all/f.####.png"), 0)
        for f in range(1, FRAMES + 1):
            self.expect(render(scene, "-o", self.folder / "one/f.####.png", "--frames", f), 0)
            name = f"f.{f:04}.png"
            self.assertEqual((self.folder / "all" / name).read_bytes(), (self.folder / "one" / name).read_bytes(), f)
        self.assertEqual(len({(self.folder / f"all/f.{f:04}.png").read_bytes() for f in range(1, FRAMES + 1)}), FRAMES)

    def test_trees_of_what_stands_are_kept(self):
        scene = self.write("film.rib", film())
        told = self.expect(render(scene, "-o", self.folder / "f.####.png", "--stats"), 0).out
        frames = [line for line in told.splitlines() if line.startswith("frame ")]
        self.assertEqual([("tree" in line) for line in frames], [False, True, True, True], told)

    def test_a_second_run_keeps_all(self):
        scene = self.write("film.rib", film())
        words = (scene, "-o", self.folder / "f.####.png", "--skip-existing")
        self.expect(render(*words), 0)
        self.assertEqual(render(*words).err.count("kept"), FRAMES)

    def test_displays_that_frames_share_have_their_numbers(self):
        depth, once = 'Display "+z.tif" "zfile" "z" ', 'Display "+only1.tif" "file" "z" '
        scene = self.write("film.rib", film(beside=lambda frame: depth + (once if frame == 1 else "")))
        self.expect(render(scene, "-o", self.folder / "all/f.####.png"), 0)
        self.expect(render(scene, "-o", self.folder / "one/f.####.png", "--frames", 2), 0)
        self.expect(render(scene, "-o", self.folder / "last/f.png"), 0)
        names = sorted(path.name for path in (self.folder / "all").iterdir())
        wanted = [f"{name}.{f:04}.{suffix}" for name, suffix in (("f", "png"), ("z", "exr")) for f in range(1, FRAMES + 1)]
        self.assertEqual(names, sorted(wanted + ["only1.exr"]))
        self.assertEqual((self.folder / "all/z.0002.exr").read_bytes(), (self.folder / "one/z.0002.exr").read_bytes())
        self.assertEqual(len({(self.folder / f"all/z.{f:04}.exr").read_bytes() for f in range(1, FRAMES + 1)}), FRAMES)
        self.assertEqual(sorted(path.name for path in (self.folder / "last").iterdir()), ["f.png", "z.exr"])

    def test_a_finding_is_told_once(self):
        scene = self.write("film.rib", film("nowhere"))
        said = self.expect(render(scene, "-o", self.folder / "f.####.png"), 0).err
        self.assertEqual(said.count("RI_SHADER_UNKNOWN"), 1, said)
        scene = self.write("film.rib", 'ReadArchive "nothere.rib"\n' + film())
        said = self.expect(render(scene, "-o", self.folder / "f.####.png"), 0).err
        self.assertEqual(said.count("RI_ARCHIVE"), 1, said)

    def test_frames_that_are_not_there(self):
        scene = self.write("film.rib", film())
        self.expect(render(scene, "-o", self.folder / "f.####.png", "--frames", "9"), 2, "none of them")
        self.expect(render(scene, "-o", self.folder / "f.png", "--frames", "2", "-q"), 0)


if __name__ == "__main__":
    main()
