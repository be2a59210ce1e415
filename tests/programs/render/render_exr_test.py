"""tests/programs/render/render_exr_test.py: parts, compressions and headers of EXR files, as another reader has them."""
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
sys.path.insert(0, str(Path(__file__).resolve().parent))
import exr_files
from programs import MATTE, SCENES, ProgramTest, main, render

SIZE = ("--size", "37x21")
AOVS = ("--aov", "N,Z,id,cost")
LOSSLESS = ("none", "rle", "zips", "zips:9", "zip:1", "zip:9", "zip:0", "piz")
LOSSY = ("pxr24", "b44", "b44a", "dwaa", "dwab:20")


def time_code(texts):
    """Digits of SMPTE 12M: of hours, minutes, seconds and frames."""
    return ":".join(f"{texts['smpte:TimeCode'][0] >> shift & 0x7f:02x}" for shift in (24, 16, 8, 0))


@unittest.skipUnless(exr_files.can_read(), "no python3-openimageio")
class Exr(ProgramTest):
    def taken(self, *words, scene=MATTE, name="a.exr"):
        picture = self.folder / name
        self.expect(render(scene, "-o", picture, *SIZE, *words), 0)
        return exr_files.read_parts(picture)

    def values(self, parts):
        return {name: values for part in parts for name, values in part["values"].items()}

    def test_every_compression_without_loss_has_the_same_numbers(self):
        usual = self.taken("--time", "0", *AOVS)
        self.assertEqual(usual[0]["texts"]["compression"], "zip")
        for name in LOSSLESS:
            for parts in ("one", "many"):
                with self.subTest(compression=name, parts=parts):
                    found = self.taken("--time", "0", *AOVS, "--compression", name, "--parts", parts)
                    self.assertEqual(found[0]["texts"].get("compression", "none"), name.split(":")[0])
                    self.assertEqual(self.values(found), self.values(usual))
        self.assertEqual(self.values(self.taken("--time", "0", *AOVS, "--compression", "zip")), self.values(usual))

    def test_compressions_with_loss_spare_numbers_that_stand_for_names(self):
        usual = self.values(self.taken("--time", "0", *AOVS))
        for name in LOSSY:
            with self.subTest(compression=name):
                parts = self.taken("--time", "0", *AOVS, "--compression", name, "--parts", "many")
                found = self.values(parts)
                self.assertEqual(found["id"], usual["id"])
                errors = [abs(a - b) for a, b in zip(usual["R"], found["R"])]
                self.assertLess(sum(errors) / len(errors), 0.01)
                whole = render(MATTE, "-o", self.folder / "b.exr", *SIZE, *AOVS, "--time", "0", "--compression", name)
                self.expect(whole, 2, "AOV_LOSSY", "--parts many")
                words = (MATTE, "-o", self.folder / "a.exr", *SIZE, *AOVS, "--time", "0", "--compression", name,
                         "--parts", "many", "--skip-existing")
                before = (self.folder / "a.exr").stat()
                self.expect(render(*words), 0)
                self.assertEqual((self.folder / "a.exr").stat().st_ino, before.st_ino)

    def test_parts_are_named_like_their_layers(self):
        parts = self.taken("--time", "0", *AOVS, "--parts", "many")
        self.assertEqual([p["texts"]["oiio:subimagename"] for p in parts], ["rgba", "N", "Z", "cost", "id"])
        self.assertEqual(parts[1]["channels"], ["N.X", "N.Y", "N.Z"])
        words = (MATTE, "-o", self.folder / "a.exr", *SIZE, *AOVS, "--time", "0", "--parts", "many", "--skip-existing")
        before = (self.folder / "a.exr").stat()
        self.expect(render(*words), 0)
        self.assertEqual((self.folder / "a.exr").stat().st_ino, before.st_ino)
        data = bytearray((self.folder / "a.exr").read_bytes())
        data[-9] ^= 64
        (self.folder / "a.exr").write_bytes(data)
        self.expect(render(*words), 0)
        self.assertEqual(exr_files.read_parts(self.folder / "a.exr"), parts)

    def test_layers_are_half_or_float(self):
        file = self.taken("--time", "0", "--aov", "N:half,Z:half:min,cost,P:float", "--depth", "float")[0]
        halves = {c for c, f in file["formats"].items() if f == "half"}
        self.assertEqual(halves, {"N.X", "N.Y", "N.Z", "Z"})
        self.expect(render(MATTE, "-o", self.folder / "b.exr", *SIZE, "--aov", "id:half"), 2, "AOV_FILTER_UNKNOWN")

    def test_matrices_lead_from_places_to_pixels(self):
        for scene in ("matte.dae", "walker.dae"):
            file = self.taken("--time", "0.5", "--aov", "P", "--spp", "1", scene=SCENES / scene)[0]
            to_camera, to_ndc = file["texts"]["worldToCamera"], file["texts"]["worldToNDC"]
            seen = 0
            for k, (x, y, z) in enumerate(zip(*(file["values"][c] for c in ("P.X", "P.Y", "P.Z")))):
                if z == 0:
                    continue
                seen += 1
                # Rows of the rotation are at right angles: its inverse is its transpose.
                moved = [c - to_camera[12 + j] for j, c in enumerate((x, y, z))]
                world = [sum(moved[j] * to_camera[4 * i + j] for j in range(3)) for i in range(3)] + [1]
                ndc = [sum(world[i] * to_ndc[4 * i + j] for i in range(4)) for j in range(4)]
                self.assertAlmostEqual(ndc[0] / ndc[3] * 37, k % 37 + 0.5, delta=0.01)
                self.assertAlmostEqual(ndc[1] / ndc[3] * 21, k // 37 + 0.5, delta=0.01)
            self.assertGreater(seen, 20)

    def test_times_and_colors_are_in_the_header(self):
        texts = self.taken("--frames", "3661", "--fps", "24", "--owner", "A. Nemo")[0]["texts"]
        self.assertEqual(texts["framesPerSecond"], [24, 1])
        self.assertEqual(time_code(texts), "00:02:32:13")
        self.assertEqual(texts["Copyright"], "A. Nemo")
        for got, want in zip(texts["chromaticities"], (0.64, 0.33, 0.3, 0.6, 0.15, 0.06, 0.3127, 0.329)):
            self.assertAlmostEqual(got, want, 5)
        texts = self.taken("--frames", "30", "--fps", "29.97", "--compression", "piz")[0]["texts"]
        self.assertEqual(texts["framesPerSecond"], [30000, 1001])
        self.assertEqual(time_code(texts), "00:00:01:00")
        self.assertNotIn("smpte:TimeCode", self.taken("--frames", "30", "--fps", "60")[0]["texts"])

    def test_only_a_stamp_changes_from_run_to_run(self):
        self.taken("--time", "0")
        self.taken("--time", "0", "--reproducible", name="b.exr")
        pictures = self.pictures()
        self.assertEqual(pictures["a.exr"], pictures["b.exr"])
        texts = self.taken("--time", "0", "--stamp")[0]["texts"]
        self.assertRegex(texts["DateTime"], r"^\d{4}:\d\d:\d\d \d\d:\d\d:\d\d$")
        self.assertIn("kinora/host", texts)

    def test_unknown_compressions_are_errors(self):
        for name in ("lzw", "zip:10", "rle:1", "zip:x", "zip:", "dwaa:-1"):
            with self.subTest(name=name):
                self.expect(render(MATTE, "-o", self.folder / "b.exr", *SIZE, "--compression", name), 2, "--compression", "dwaa")


if __name__ == "__main__":
    main()
