"""tests/programs/broken_scene_test.py: damaged scenes give findings, never a crash or a hang."""
import random

from programs import MATTE, ProgramTest, main, render

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
