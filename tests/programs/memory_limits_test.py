"""tests/programs/memory_limits_test.py: address space that ends at any point ends a program with 75, and nothing else."""
import resource
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from programs import MATTE, SHADERS, ProgramTest, main, run

MEGABYTES = list(range(16, 64, 6)) + list(range(64, 340, 12)) + [400, 600, 1000]
SMALL = ("--size", "32x18", "--spp", "1", "--threads", "4")


def within(megabytes):
    def limit():
        resource.setrlimit(resource.RLIMIT_AS, (megabytes << 20, megabytes << 20))
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    return limit


class MemoryLimits(ProgramTest):
    def check(self, program, *words):
        codes = []
        for megabytes in MEGABYTES:
            if run(program, "--version", preexec_fn=within(megabytes)).code != 0:
                continue  # the loader's own end
            with self.subTest(program=program, megabytes=megabytes):
                result = run(program, *words, preexec_fn=within(megabytes))
                self.assertIn(result.code, (0, 75), result)
                if result.code == 75:
                    self.assertRegex(result.err, f"{program}: out of (memory|threads)|not enough memory")
                self.assertEqual([f.name for f in self.folder.iterdir() if f.suffix == ".tmp"], [])
                codes.append(result.code)
        if 0 not in codes:
            self.skipTest("the program does not run in a limited address space (sanitizers)")
        self.assertEqual(codes[-1], 0, "the most memory is too little")  # threads decide between

    def test_render(self):
        self.check("kinora-render", MATTE, "--time", "1", "-o", self.folder / "a.png", *SMALL)

    def test_play(self):
        self.check("kinora-play", MATTE, "--headless", "--screenshot", self.folder / "b.png", *SMALL)

    def test_convert(self):
        self.check("kinora-convert", MATTE, self.folder / "c.glb")

    def test_validate(self):
        self.check("kinora-validate", MATTE)

    def test_shade(self):
        self.check("kinora-shade", "run", SHADERS / "matte.sl", "--size", "32x32")


if __name__ == "__main__":
    main()
