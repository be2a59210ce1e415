"""tests/programs/broken_scene_test.py: damaged scenes give findings, never a crash or a hang."""
import random

import re

from programs import MATTE, ProgramTest, main, render, run

SMALL = ("--size", "8x8", "--spp", "1", "--threads", "1")
CUTS = 48
FLIPS = 64


class Damaged(ProgramTest):
    def check(self, data, what):
        scene = self.folder / "damaged.dae"
        scene.write_bytes(data)
        result = render(scene, "-o", self.folder / "a.png", *SMALL)
        self.assertIn(result.code, (0, 3, 4), f"{what}: {result}")
        if result.code != 0:
            self.assertIn("error", result.err, what)
        return result.code

    def test_truncated_scenes_are_unreadable_or_partly_shown(self):
        data = MATTE.read_bytes()
        codes = [self.check(data[: len(data) * i // CUTS], f"cut {i}/{CUTS}") for i in range(CUTS)]
        self.assertIn(3, codes)

    def test_what_cut_the_scene_is_the_error(self):
        """Its line and column are those of the damage, and what follows from it is not told."""
        text = MATTE.read_text()
        cut = text[: text.index("<instance_geometry") + 9]
        other = text.replace("</library_effects>", "")
        rows = [("cut", cut, cut.count("\n") + 1, "unclosed token"),
                ("tag", other, other.count("\n") + (0 if other.endswith("\n") else 1), "mismatched tag")]
        for name, damaged, line, why in rows:
            scene = self.write(f"{name}.dae", damaged)
            for words in (("kinora-render", scene, "-o", self.folder / "a.png", *SMALL),
                          ("kinora-render", scene, "-o", self.folder / "a.png", *SMALL, "--strict"),
                          ("kinora-convert", scene, self.folder / "a.glb"), ("kinora-convert", scene, self.folder / "a.dae")):
                with self.subTest(f"{name} {words[0]} {words[-1]}"):
                    result = self.expect(run(*words), 3)
                    errors = re.findall(r"^.*?: error: .*", result.err, re.M)
                    self.assertEqual(len(errors), 1, errors)
                    self.assertRegex(errors[0], rf"{name}\.dae:{line}:\d+: error: not well-formed: {why} \[XML_SYNTAX\]$")

    def test_flipped_bits_are_found_or_harmless(self):
        data = MATTE.read_bytes()
        chance = random.Random(20250101)
        for _ in range(FLIPS):
            at, bit = chance.randrange(len(data)), chance.randrange(8)
            damaged = bytearray(data)
            damaged[at] ^= 1 << bit
            self.check(bytes(damaged), f"byte {at} bit {bit}")


if __name__ == "__main__":
    main()
