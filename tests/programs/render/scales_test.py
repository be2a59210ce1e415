"""tests/programs/render/scales_test.py: the size and place of a scene do not show, whatever it holds."""
import shutil
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from programs import SHARED, ProgramTest, main, render
from scaled_scenes import KINDS, difference, png, scaled

MOST = 0.001  # mean difference, of 1
MOVE = (1e9, -1e9, 1e9)
# What the fast tier computes otherwise than the precise one.
FAST = ("normals", "bump", "displacement", "shadow", "moving instance", "skin")
# By others: a bump map, a skin that no pose of its bind explains, many textures.
OTHERS = ("torque_teleporter", "cts_skin_on_morph", "webglue_cat")


class Scales(ProgramTest):
    def picture(self, name, text, *words):
        path, out = self.write(f"{name}.dae", text), self.folder / f"{name}.png"
        said = self.expect(render(path, "-o", out, "--size", "64x48", "--spp", "2", "--time", "0.4", "--threads", "1",
                                  "--progress", "none", *words), 0)
        self.assertNotIn("[NODE_SINGULAR]", said.err)
        return out, said.err

    def compare(self, name, text, exponents, *words):
        """Differences to the scene at scale 1 that are too large."""
        home, _ = self.picture(f"{name}-home", scaled(text), *words)
        self.assertGreater(sum(map(sum, png.read(home)[2])), 0, name)
        places = [(f"1e{k}", 10.0 ** k, (0, 0, 0)) for k in exponents] + [("moved", 1, MOVE)]
        wrong = []
        for place, scale, move in places:
            other, said = self.picture(f"{name}-{place}", scaled(text, scale, move), *words)
            self.assertNotIn("[SCENE_SIZE]", said, place)
            if (apart := difference(home, other)) > MOST:
                wrong.append(f"{name} at {place}: {apart:.4f}")
        return wrong

    def all(self, kinds, exponents, *words):
        with ThreadPoolExecutor(2) as pool:
            found = pool.map(lambda k: self.compare(k, KINDS[k], exponents, *words), kinds)
        self.assertEqual([line for lines in found for line in lines], [])

    def test_every_kind_of_content_has_one_picture_at_any_scale(self):
        self.all(KINDS, (-12, -9, 9, 11))

    def test_quick_pictures_too(self):
        self.all(FAST, (-12, -7, 7, 10, 11), "--quality", "preview")

    def test_scenes_of_others_too(self):
        scenes = [f for name in OTHERS for f in (SHARED / "scenes" / name).glob("*.[dD][aA][eE]")]
        for file in scenes:
            for picture in file.parent.iterdir():
                if picture.is_file() and picture.suffix.lower() not in (".dae",):
                    shutil.copy(picture, self.folder)
            self.assertEqual(self.compare(file.stem, file.read_text(errors="replace"), (-12, -6, 9)), [])
        self.whole_if(scenes)

    def test_a_sphere_with_normals_of_a_billionth(self):
        cases = sorted((SHARED / "cases").glob("23-scale-1*.dae"))
        shown = [self.picture(case.stem, case.read_text())[0] for case in cases]
        self.assertLess(max([difference(shown[0], other) for other in shown], default=0), MOST)
        self.whole_if(cases)


main()
