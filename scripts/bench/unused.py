#!/usr/bin/env python3
"""Measures what content that a picture does not need costs in a frame: a row for each kind that
tests/programs/render/unused_content_test.py adds to walker.dae. Its time is quoted; the test counts the work.

    scripts/bench/unused.py [--pairs 200] [--page] [WORD...]

Runs of ten frames with and without the content alternate, on one thread. Each frame's time is divided by
that of the same frame in the run beside it. A row shows the median of these ratios and the interval that
holds the true median with 95 %, by order statistics. Beside it stands the ratio of the instructions that
a frame takes, by valgrind's cachegrind, which does not depend on what else the machine does. WORD: rows
whose names hold it. --page writes the table into docs/trade.md.
"""
import argparse
import json
import math
import os
import re
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
os.environ.setdefault("KINORA_SOURCE_DIR", str(ROOT))
sys.path[:0] = [str(ROOT / "tests/programs"), str(ROOT / "tests/programs/render")]
import unused_content_test as content  # noqa: E402
from programs import command, render  # noqa: E402

PAGE = ROOT / "docs/trade.md"
BEGIN, END = "<!-- measured by scripts/bench/unused.py -->\n", "<!-- end of what is not needed -->"
FRAMES = 10  # of a run
# What is added, how many, and what the upper end of the interval must stay below.
ROWS = (
    ("unused channels of two keys", 10000, lambda n: content.unused_animations(n, 2), 1.02),
    ("unused effects of 100 lines", 1000, content.unused_effects, 1.02),
    ("unused textures of 4096x4096", 200, content.unused_images, 1.02),
    ("meshes out of view", 500, content.meshes_out_of_view, 1.05),
    ("nodes that stand", 1000, content.static_nodes, 1.02),
    ("black lights", 100, content.black_lights, 1.02),
    ("spots that look away", 100, content.lights_that_miss, 1.02),
    ("lights of another category", 100, lambda n: content.one_lamp_and(*content.lamps(n, "fill")), 1.02),
    ("unused parameters and outputs", 1000, content.unused_parameters, 1.02),
)
# Of walker.dae no shader asks for a category. Lamps are added to it without its author.
OTHER_BASES = {"lights of another category": content.one_lamp_and(), "black lights": content.AUTHORLESS,
               "spots that look away": content.AUTHORLESS}


def options_of(scene, frames):
    return [scene, "-o", "null", "--size", "192x108", "--spp", "2", "--frames", f"2-{frames + 1}", "--threads", "1", "-q"]


def frames_ms(scene):
    done = render(*options_of(scene, FRAMES), "--stats=json")
    if done.code:
        sys.exit(done.err)
    return [frame["total_ms"] for frame in json.loads(done.out)["frames"]]


def instructions(scene):
    """Of four frames, what is loaded and built before them left out."""
    def of(frames):
        done = subprocess.run(["valgrind", "--tool=cachegrind", "--cache-sim=no", "--cachegrind-out-file=/dev/null",
                               *command("kinora-render", *options_of(scene, frames), "--target", "avx2")],
                              capture_output=True, text=True)
        if done.returncode:
            sys.exit(done.stderr)
        return int(re.search(r"I\s+refs:\s+([\d,]+)", done.stderr)[1].replace(",", ""))
    return of(5) - of(1)


def interval(values):
    """The median and the order statistics that hold the true one with 95 %."""
    values, n = sorted(values), len(values)
    reach = 0.98 * math.sqrt(n)
    low, high = math.floor(n / 2 - reach), math.ceil(n / 2 + reach)
    return statistics.median(values), values[max(low - 1, 0)], values[min(high, n - 1)]


def ratios(base, more, pairs):
    found = []
    while len(found) < pairs:
        first, second = (base, more) if len(found) // FRAMES % 2 else (more, base)
        times = {first: frames_ms(first), second: frames_ms(second)}
        found += [m / b for m, b in zip(times[more], times[base])]
    return found


def table(options):
    lines = ["| added to walker.dae | time of a frame | 95 % of the median | allowed | instructions |", "|---|---|---|---|---|"]
    with tempfile.TemporaryDirectory() as name:
        base, more = Path(name) / "base.dae", Path(name) / "more.dae"
        for row, count, make, most in ROWS:
            if options.words and not any(word in row for word in options.words):
                continue
            base.write_text(OTHER_BASES.get(row, content.WALKER))
            more.write_text(make(count))
            middle, low, high = interval(ratios(base, more, options.pairs))
            verdict = "" if high < most else ", not held"
            counted = instructions(more) / instructions(base)
            lines.append(f"| {count} {row} | {middle:.3f} | {low:.3f} to {high:.3f} | {most}{verdict} | {counted:.4f} |")
            print(lines[-1], flush=True)
    return lines


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("words", nargs="*", metavar="WORD")
    parser.add_argument("--pairs", type=int, default=200)
    parser.add_argument("--page", action="store_true", help="writes the table into docs/trade.md")
    options = parser.parse_args()
    lines = table(options)
    if options.page:
        text = PAGE.read_text()
        begin = text.index(BEGIN) + len(BEGIN)
        PAGE.write_text(text[:begin] + "\n" + "\n".join(lines) + "\n\n" + text[text.index(END):])


if __name__ == "__main__":
    main()
