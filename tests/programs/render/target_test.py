"""tests/programs/render/target_test.py: --target-ms and --target-error keep their word."""
import json
import math
import struct
import sys
import unittest
import zlib
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from programs import MATTE, SCENES, SOURCE, ProgramTest, main, render

sys.path.insert(0, str(SOURCE / "scripts"))
from sheet import png  # noqa: E402

WALKER = SCENES / "walker.dae"
BLACK = ("--background", "0,0,0", "--threads", "2", "--progress", "none")


def linear(byte):
    """IEC 61966-2-1, decoded."""
    c = byte / 255
    return c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4


LINEAR = [linear(byte) for byte in range(256)]


def read_png(path):
    """The linear colors of a picture of kinora-render, red green blue red ..."""
    parts = list(png.chunks(path.read_bytes()))
    width, height = struct.unpack(">II", parts[0][1][:8])
    raw = zlib.decompress(b"".join(body for kind, body in parts if kind == b"IDAT"))
    colors, above, stride = [], bytes(4 * width), 4 * width + 1
    assert len(raw) == stride * height, "8-bit RGBA"
    for at in range(0, len(raw), stride):
        above = png.unfilter(raw[at], bytearray(raw[at + 1:at + stride]), above, 4)
        colors += [LINEAR[byte] for k, byte in enumerate(above) if k % 4 < 3]
    return colors


def rmse(a, b):
    return math.sqrt(sum((x - y) ** 2 for x, y in zip(a, b)) / len(a))


def samples_of(result):
    return [frame["samples"] for frame in json.loads(result.out)["frames"]]


class Errors(ProgramTest):
    SIZE = ("--size", "40x30", *BLACK)

    def target(self, error, frames, name):
        return self.expect(render(WALKER, "-o", self.folder / f"{name}.####.png", "--frames", frames,
                                  *self.SIZE, "--target-error", error, "--stats=json"), 0,
                           f"--target-error {error}: settings of", "their noise is estimated")

    def test_frames_are_as_near_to_the_reference_as_they_were_to_be(self):
        frames = "20-60x20"
        self.expect(render(WALKER, "-o", self.folder / "r.####.png", "--frames", frames, *self.SIZE,
                           "--quality", "reference", "--spp", "512"), 0)
        counts = []
        for error in (0.03, 0.015):
            counts.append(samples_of(self.target(f"rmse:{error}", frames, "t")))
            for frame in (20, 40, 60):
                near = rmse(read_png(self.folder / f"t.{frame:04}.png"),
                            read_png(self.folder / f"r.{frame:04}.png"))
                self.assertLess(near, error, f"frame {frame}: {counts[-1]} samples")
        # Half of the error takes at least twice the samples: noise falls no faster than by 1 / n.
        for few, many in zip(*counts):
            self.assertGreaterEqual(many, 2 * few)

    def test_a_frame_is_the_same_alone(self):
        self.target("flip:0.05", "30-40x10", "shot")
        self.target("flip:0.05", "40", "alone")
        self.assertEqual((self.folder / "shot.0040.png").read_bytes(),
                         (self.folder / "alone.0040.png").read_bytes())

    def test_frames_that_exist_are_kept_for_the_same_target_alone(self):
        words = (MATTE, "-o", self.folder / "m.png", "--frames", "0", *self.SIZE, "--stats=json")
        self.expect(render(*words, "--target-error", "0.05"), 0)
        kept = render(*words, "--target-error", "0.05", "--skip-existing")
        self.assertTrue(json.loads(self.expect(kept, 0).out)["frames"][0]["state"] == "kept", kept)
        other = render(*words, "--target-error", "0.04", "--skip-existing")
        self.assertFalse(json.loads(self.expect(other, 0).out)["frames"][0]["state"] == "kept", other)


class Times(ProgramTest):
    def shot(self, ms):
        result = render(WALKER, "-o", "null", "--frames", "1-24", "--size", "40x30", *BLACK,
                        "--quality", "preview", "--target-ms", ms, "--stats=json")
        self.assertEqual(result.code, 0, result.err)
        self.assertIn(f"--target-ms {ms}: settings of the command line", result.err)
        self.assertIn("16 frames after the first 8", result.err)
        frames = json.loads(result.out)["frames"][8:]
        return [sum(frame[key] for frame in frames) / len(frames) for key in ("total_ms", "samples")]

    def times_kept(self):
        """How far two targets are missed, as shares, and samples of the longer by those of the shorter."""
        # Of what this machine takes for 16 samples now, whatever else it does.
        result = render(WALKER, "-o", "null", "--frames", "1-8", "--size", "40x30", *BLACK,
                        "--quality", "preview", "--spp", "16", "--stats=json")
        frames = json.loads(self.expect(result, 0).out)["frames"]
        ms = max(1, round(sum(frame["total_ms"] for frame in frames) / len(frames)))
        short, long = self.shot(ms), self.shot(3 * ms)
        return abs(short[0] / ms - 1), abs(long[0] / (3 * ms) - 1), long[1] / short[1]

    def test_frames_take_the_time_that_they_were_to_take(self):
        # A machine may change its speed between two runs, though not in each of four tries.
        tries = []
        for _ in range(4):
            tries.append(self.times_kept())
            short, long, samples = tries[-1]
            if short < 0.3 and long < 0.3 and samples > 1.5:  # 48 samples to 16, less what a frame takes besides
                return
        self.fail(f"none of four tries kept both times: {tries}")

    def test_a_time_that_no_settings_reach_is_told(self):
        self.expect(render(WALKER, "-o", "null", "--target-ms", "0.01", *BLACK), 1,
                    "error: --target-ms 0.01: a frame of 640x", "settings of draft", "--scale")


class Usage(ProgramTest):
    def test_mistakes_are_told(self):
        rows = [
            (("--target-error", "much"), "takes a FLIP of 0.01 or flip:0.01"),
            (("--target-error", "psnr:0.1"), "not 'psnr:0.1'"),
            (("--target-ms", "0"), "--target-ms"),
            (("--target-ms", "10", "--target-error", "0.1"), "excludes"),
            (("--target-ms", "10", "--spp", "4"), "leave --spp out"),
            (("--target-ms", "10", "--tradeoff", "out"), "excludes"),
            (("--measured", "out"), "goes with --target-ms"),
        ]
        for words, text in rows:
            with self.subTest(words=words):
                out = () if "--tradeoff" in words else ("-o", "null")
                self.expect(render(MATTE, *out, *words), 2, text)

    def test_a_file_of_measurements_that_does_not_fit_is_told_and_left(self):
        other = self.write("tradeoff.json", json.dumps(
            {"format": "kinora-tradeoff", "version": 1, "fingerprint": "0" * 16}))
        for file, text in ((other, "is of another scene"), (self.folder / "none", "cannot be read"),
                           (self.write("a.json", "[1, 2"), "is no tradeoff.json")):
            self.expect(render(MATTE, "-o", "null", "--frames", "0", "--size", "16x12", "--target-error",
                               "0.1", "--measured", file, *BLACK), 0, text)


if __name__ == "__main__":
    main()
