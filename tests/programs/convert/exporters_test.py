"""tests/programs/convert/exporters_test.py: what an exporter of others writes in COLLADA looks as what it
writes in glTF; loader and validator say the same of skins."""
import os
import re
import subprocess
import unittest
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from convert_test import outline
from programs import SOURCE, TEST_DATA, ProgramTest, blender_writes_gltf, main, render, run

RULES = TEST_DATA / "rules"
SKINS = re.compile(r"\[(SKIN_NODE_TRANSFORM|SKIN_MIXED_MIRROR)\]")
ALL = ("matrix", "decomposed", "sampled")
# Decomposed, Blender gives bones the motion of their armature, or none.
WAYS = {"moving": ALL, "turning": ALL, "still_skin": ("matrix", "sampled"),
        "moved_skin": ("matrix", "sampled")}
TIMES = [frame / 24 for frame in (1, 13, 25)]  # Blender counts from 1, both files from there


class Exporters(ProgramTest):
    def outline(self, scene, time):
        picture = self.folder / "a.png"
        self.expect(render(scene, "-o", picture, "--size", "128x128", "--spp", "9", "--time", time,
                           "--progress", "none"), 0)
        return outline(picture)

    @unittest.skipUnless(blender_writes_gltf(), "no blender with numpy")
    def test_blenders_collada_looks_as_its_gltf(self):
        done = subprocess.run(["blender", "-b", "--factory-startup", "-P",
                               SOURCE / "tests/programs/convert/blender_dae.py", "--", self.folder],
                              capture_output=True, text=True, timeout=240,
                              env={**os.environ, "PATH": "/usr/bin:/bin"})  # Debian's python
        for name, ways in WAYS.items():
            for time in TIMES:
                self.assertTrue((self.folder / f"{name}.glb").exists(), done.stdout + done.stderr)
                wanted = self.outline(self.folder / f"{name}.glb", time)
                for way in ways:
                    with self.subTest(f"{name}.{way} at {time:.2f}"):
                        found = self.outline(self.folder / f"{name}.{way}.dae", time)
                        both = sum(x and y for x, y in zip(wanted, found))
                        either = sum(x or y for x, y in zip(wanted, found))
                        self.assertGreater(both, 100)
                        self.assertGreater(both / either, 0.98)


class Agreement(ProgramTest):
    def test_loader_and_validator_say_the_same_of_skins(self):
        scenes = sorted(RULES.glob("SKIN_NODE_TRANSFORM*.dae")) + \
            sorted(RULES.glob("SKIN_MIXED_MIRROR*.dae"))
        self.assertGreater(len(scenes), 8)
        for scene in scenes:
            with self.subTest(scene.name):
                loaded = render(scene, "-v", "-o", self.folder / "a.png", "--size", "8x8", "--spp", "1",
                                "--time", "0")
                validated = run("kinora-validate", scene)
                self.assertEqual(set(SKINS.findall(loaded.err)),
                                 set(SKINS.findall(validated.out + validated.err)))


if __name__ == "__main__":
    main()
