"""tests/programs/pairs_test.py: files that say the same render alike, files that do not differ.

The build writes the files by tests/conformance/make.py. A family's pictures are compared with one
another, never with pictures of an earlier Kinora.
"""
import itertools
import struct
import sys
import zlib
from concurrent.futures import ThreadPoolExecutor

from programs import SOURCE, TEST_DATA, ProgramTest, main, render

sys.path[:0] = [str(SOURCE / "tests/conformance"), str(SOURCE / "scripts")]
import make  # noqa: E402
from sheet import png  # noqa: E402

FOLDER = TEST_DATA / "conformance"
SIZE = 48
# Of 255. Edges may fall on the other side of a sample where corners were computed another way.
ALIKE, ALIKE_PIXELS = 3, 0.01
# Two pictures differ when at least this many pixels do, by this much.
APART, APART_PIXELS = 8, 0.005


def read_png(path):
    """The RGBA pixels of a picture of kinora-render."""
    parts = list(png.chunks(path.read_bytes()))
    width, height = struct.unpack(">II", parts[0][1][:8])
    raw = zlib.decompress(b"".join(body for kind, body in parts if kind == b"IDAT"))
    pixels, above, stride = [], bytes(4 * width), 4 * width + 1
    assert len(raw) == stride * height, "8-bit RGBA"
    for at in range(0, len(raw), stride):
        above = png.unfilter(raw[at], bytearray(raw[at + 1:at + stride]), above, 4)
        pixels += [tuple(above[x:x + 4]) for x in range(0, 4 * width, 4)]
    return pixels


def share_apart(a, b, limit):
    """The share of pixels that differ by more than `limit` in some channel."""
    return sum(any(abs(x - y) > limit for x, y in zip(p, q)) for p, q in zip(a, b)) / len(a)


def scenes(kind, family):
    """Name -> file of those that are rendered: no parts, no images."""
    return {f.stem + ("" if f.suffix == ".dae" else f.suffix): f
            for f in sorted((FOLDER / kind / family).iterdir())
            if f.suffix in (".dae", ".zae", ".kmz")}


class Pairs(ProgramTest):
    def pictures_of(self, kind, family, options):
        def picture(item):
            name, file = item
            out = self.folder / f"{name}.png"
            words = ["--size", f"{SIZE}x{SIZE}", "--spp", "4", "--threads", "1", *options]
            if not options:
                words += ["--time", "0"]
            result = render(file, "-o", out, *words)
            self.assertEqual(result.code, 0, f"{file}: {result}")
            self.assertNotIn("error:", result.err, file)
            return name, read_png(out)
        with ThreadPoolExecutor(2) as pool:
            return dict(pool.map(picture, scenes(kind, family).items()))

    def judge(self, kind, alike):
        module = make.KINDS[kind]
        for family in module.FAMILIES:
            pictures = self.pictures_of(kind, family, module.OPTIONS.get(family, []))
            self.assertGreaterEqual(len(pictures), 2, family)
            for (a, one), (b, other) in itertools.combinations(pictures.items(), 2):
                with self.subTest(family=family, a=a, b=b):
                    apart = share_apart(one, other, ALIKE if alike else APART)
                    if alike:
                        self.assertLessEqual(apart, ALIKE_PIXELS)
                    else:
                        self.assertGreaterEqual(apart, APART_PIXELS)
            seen = [sum(p[3] for p in picture) for picture in pictures.values()]
            self.assertGreater(max(seen), 0, f"{family}: nothing is seen")

    def test_equal_files_render_alike(self):
        self.judge("equal", True)

    def test_other_files_render_otherwise(self):
        self.judge("differ", False)

    def test_the_maker_writes_the_same_each_time(self):
        built = {p.relative_to(FOLDER).as_posix(): p.read_bytes() for kind in make.KINDS
                 for p in (FOLDER / kind).glob("**/*") if p.is_file()}
        made = make.files()
        self.assertEqual(sorted(built), sorted(made))
        for name, content in made.items():
            self.assertEqual(built[name], content, name)


if __name__ == "__main__":
    main()
