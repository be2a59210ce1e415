"""tests/programs/render/render_aovs_test.py: AOVs in files, as another reader has them."""
import json
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
sys.path.insert(0, str(Path(__file__).resolve().parent))
import exr_files
from programs import MATTE, ProgramTest, main, render

SIZE = ("--size", "32x24", "--time", "0")


@unittest.skipUnless(exr_files.can_read(), "no python3-openimageio")
class Files(ProgramTest):
    def taken(self, *words, name="a.exr"):
        picture = self.folder / name
        self.expect(render(MATTE, "-o", picture, *SIZE, *words), 0)
        return exr_files.read(picture)

    def test_every_builtin_has_its_channels_and_says_how_it_was_made(self):
        file = self.taken("--aov", "all", "--spp", "4")
        rows = json.loads(render(MATTE, "--list", "builtins", "--json").out)["builtins"]
        self.assertGreater(len(rows), 10)
        for row in rows:
            if row["name"].startswith("light_default"):  # `all` takes no single lights
                continue
            for channel in row["channels"]:
                self.assertIn(channel, file["channels"])
            said = json.loads(file["texts"]["kinora/aov/" + row["name"]])
            self.assertEqual(said["filter"], row["filter"])
            self.assertEqual(said["premultiplied"], row["premultiplied"])
            self.assertAlmostEqual(said["background"] / 1e38, row["background"] / 1e38, 5)

    def test_numbers_have_names(self):
        file = self.taken("--aov", "object_id,material_id", "--spp", "8")
        paths = [n["path"] for n in json.loads(render(MATTE, "--list", "nodes", "--json").out)["nodes"]]
        names = json.loads(file["texts"]["kinora/object_id"])
        seen = {v for v in file["values"]["object_id"] if v}
        self.assertGreater(len(seen), 0)
        for number in seen:
            self.assertIn(names[str(int(number))], paths)

    def test_filters_are_chosen_by_name(self):
        nearest = self.taken("--aov", "Z", "--spp", "16")
        least = self.taken("--aov", "Z:min", "--spp", "16", name="b.exr")
        self.assertEqual(json.loads(least["texts"]["kinora/aov/Z"])["filter"], "min")
        pairs = list(zip(nearest["values"]["Z"], least["values"]["Z"]))
        self.assertTrue(all(b <= a for a, b in pairs))
        self.assertTrue(any(b < a for a, b in pairs))
        self.expect(render(MATTE, "-o", self.folder / "c.exr", "--aov", "Z:mode", *SIZE), 2, "AOV_FILTER_UNKNOWN", "nearest")

    def test_the_picture_and_its_fingerprint(self):
        plain = self.taken("--spp", "4")
        with_aovs = self.taken("--spp", "4", "--aov", "all", name="b.exr")
        for channel in "RGBA":
            self.assertEqual(plain["values"][channel], with_aovs["values"][channel])
        words = (MATTE, "-o", self.folder / "b.exr", *SIZE, "--spp", "4", "--skip-existing")
        before = (self.folder / "b.exr").read_bytes()
        self.expect(render(*words, "--aov", "all"), 0)
        self.assertEqual((self.folder / "b.exr").read_bytes(), before)
        self.expect(render(*words, "--aov", "Z"), 0)
        self.assertNotIn("N.X", exr_files.read(self.folder / "b.exr")["channels"])

    def test_explain_names_them(self):
        rows = json.loads(render(MATTE, "--explain=json", "--aov", "Z:max,uv", "-q").out)["aovs"]
        self.assertEqual([(r["subject"], r["why"]) for r in rows],
                         [("Z", "filter max, background 1e+38"), ("uv", "filter nearest, background 0")])


if __name__ == "__main__":
    main()
