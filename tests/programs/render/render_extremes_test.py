"""tests/programs/render/render_extremes_test.py: pictures of extreme shape and extreme values."""
import struct
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from programs import ProgramTest, main, render
from written_scenes import CAMERA, EYE, document, geometries, place, png, rsl, square


def colored(text):
    """A scene whose one square, which fills any picture, has that colour."""
    code = f"surface s(output varying float far = 0;) {{ Oi = 1; Ci = color({text}); far = comp(Ci, 0); }}"
    return document(CAMERA + rsl(code) + geometries(square(half=1e6)), EYE + place())


def srgb_byte(linear):
    """IEC 61966-2-1."""
    return round(255 * (1.055 * linear ** (1 / 2.4) - .055 if linear > .0031308 else 12.92 * linear))


def exr_channels(data):
    """Name and type (1: half, 2: float) of each channel of a scan-line OpenEXR file, by its file layout."""
    at = data.index(b"channels\0chlist\0") + 20
    found = {}
    while data[at]:
        end = data.index(b"\0", at)
        found[data[at:end].decode()] = struct.unpack("<i", data[end + 1:end + 5])[0]
        at = end + 17
    return found


class RenderExtremes(ProgramTest):
    def picture(self, color, *words, out="p.png"):
        self.expect(render(self.write("s.dae", colored(color)), "-o", self.folder / out, "-q", *words), 0)
        return self.folder / out

    def test_pictures_of_one_pixel_and_of_one_column(self):
        want = bytes(map(srgb_byte, (.25, .5, 1)))
        for size, shape in (("1x1", (1, 1)), ("1x32768", (1, 32768)), ("32768x1", (32768, 1))):
            width, height, rows = png.read(self.picture(".25, .5, 1", "--size", size, "--spp", "1"))
            self.assertEqual((width, height), shape)
            for row in rows:
                self.assertEqual(row, want * width, size)

    def test_eight_bits_clamp(self):
        _, _, rows = png.read(self.picture("1e30, 1e-30, -1e30", "--size", "2x2"))
        self.assertEqual(list(rows[0]), [255, 0, 0] * 2)

    def test_colors_of_an_exr_are_half_and_outputs_float(self):
        data = self.picture("1e30, 1e-30, -1e30", "--size", "2x2", "--aov", "far", out="p.exr").read_bytes()
        types = exr_channels(data)
        self.assertEqual({name: types[name] for name in "RGBA"}, dict.fromkeys("RGBA", 1))
        self.assertEqual([kind for name, kind in types.items() if "far" in name], [2], types)


if __name__ == "__main__":
    main()
