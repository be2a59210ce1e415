"""tests/programs/render/displays_test.py: displays of a RIB file, written beside its picture."""
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from programs import ProgramTest, main, render

DISPLAYS = ('Display "a.tif" "file" "rgba" Display "+a.tif" "framebuffer" "rgb" Display "+elsewhere/z.tif" "zfile" "z" '
            'Display "+n.tif" "file" "N" "quantize" [128 255 0 255] Display "+none.tif" "file" "glow" ')
WORLD = 'WorldBegin Surface "constant" Translate 0 0 3 Disk 0 .8 360 WorldEnd '


class Displays(ProgramTest):
    def render(self, *words, displays=DISPLAYS, says=""):
        scene = self.write("scene.rib", "Format 16 16 1 " + displays + WORLD)
        (self.folder / "out").mkdir(exist_ok=True)
        return self.expect(render(scene, "-o", self.folder / "out/p.png", "--progress", "none", *words), 0, says)

    def files(self):
        return {path.name: path.read_bytes() for path in (self.folder / "out").iterdir()}

    def test_each_is_a_file_in_the_folder_of_the_picture(self):
        self.render(says="RI_OUTPUT_UNKNOWN")
        files = self.files()
        self.assertEqual(sorted(files), ["n.png", "p.png", "z.exr"])
        self.assertIn(b"Z\0", files["z.exr"][:1024])
        self.assertFalse((self.folder / "elsewhere").exists())

    def test_one_that_is_gone_is_made_again(self):
        self.render("--skip-existing")
        before = self.files()
        (self.folder / "out/n.png").unlink()
        self.render("--skip-existing")
        self.assertEqual(self.files(), before)

    def test_one_that_cannot_be_written_is_an_error(self):
        (self.folder / "out/n.png").mkdir(parents=True)
        scene = self.write("scene.rib", "Format 16 16 1 " + DISPLAYS + WORLD)
        result = render(scene, "-o", self.folder / "out/p.png", "--progress", "none")
        self.assertNotEqual(result.code, 0)
        self.assertIn("FRAME_UNWRITABLE", result.err)


if __name__ == "__main__":
    main()
