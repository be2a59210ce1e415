#!/usr/bin/env python3
"""tests/programs/play_goldens_test.py: a tour of each scene by a script without a window shows the pictures of
tests/programs/goldens, within a tolerance.

Three pictures a scene side by side: moved by hand; played, then another frame; its shader changed. KINORA_WRITE_GOLDENS=1
writes them from the script; look at them before they are committed."""
import json
import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from programs import BIN, SCENES, SHARED, SOURCE, main

sys.path.insert(0, str(SOURCE / "scripts/sheet"))
import png  # noqa: E402

PROGRAM = BIN / "kinora-play"
GOLDENS = SOURCE / "tests/programs/goldens"
WIDTH, HEIGHT = 96, 54
OPTIONS = ("--size", f"{WIDTH}x{HEIGHT}", "--quality", "preview", "--spp", "4", "--threads", "2")
MINE = [SCENES / f"{name}.dae" for name in ("attach", "court", "layers", "matte", "rays", "tintoy", "walker")]
OTHERS = [SHARED / "scenes" / name for name in (
    "gltf_rigged_figure/RiggedFigure.dae", "chinedufn_control_bones/leg-with-control-bones.dae", "webglue_cat/cat.dae",
    "assimp_animation_clips/library_animation_clips.dae", "cts_skin_on_morph/skin_on_morph.dae")]
BROKEN = "surface g() { Ci = (; }"
GOOD = "surface g() { normal n = normalize(N); Ci = mix(color(0.1, 0.2, 0.5), color(1, 0.8, 0.3), abs(n . normalize(I))); Oi = 1; }"
# Of 0 to 255. Other compilers may turn a sample at an edge.
MEAN, MOST, MOST_SHARE = 1.5, 24, 0.02


def select(scene):
    """A line that selects the first material."""
    listed = subprocess.run([BIN / "kinora-render", scene, "--list", "materials", "--json"], capture_output=True, text=True, timeout=60)
    material = json.loads(listed.stdout)["materials"][0]
    return f"select_material {material['name']}"


def set_text(text):
    return f'set_text "{text}"'


def side_by_side(files):
    pictures = [png.read(file)[2] for file in files]
    return [b"".join(rows) for rows in zip(*pictures)]


def difference(a, b):
    """The mean of all differences of bytes, and the share of those that are large."""
    total = large = count = 0
    for x, y in zip(a, b):
        apart = [abs(p - q) for p, q in zip(x, y)]
        total, large, count = total + sum(apart), large + sum(d > MOST for d in apart), count + len(apart)
    return total / count, large / count


class Tour(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix="kinora_goldens_"))
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)

    def copy(self, scene):
        """What is edited and saved is a copy, with its pictures."""
        to = self.folder / "scene"
        if not to.exists():
            shutil.copytree(scene.parent, to, ignore=shutil.ignore_patterns("*.kinora", "blessed"))
        return to / scene.name

    def check(self, scene, rows):
        golden = GOLDENS / f"{scene.stem}.png"
        self.assertTrue(golden.exists(), f"no {golden}: KINORA_WRITE_GOLDENS=1 writes it")
        mean, large = difference(png.read(golden)[2], rows)
        if mean > MEAN or large > MOST_SHARE:
            kept = Path(tempfile.gettempdir()) / f"kinora_{scene.stem}.png"
            png.write(kept, 3 * WIDTH, HEIGHT, rows)
            self.fail(f"{kept} is not {golden}: {mean:.2f} apart on average, {large:.1%} of it far")

    def by_script(self, scene, material):
        shots = [self.folder / f"{k}.png" for k in range(3)]
        lines = ["wait refined", "orbit 24 12", f"screenshot {shots[0]}", "play on", "wait 0.3", "play off", "first", "next", "next",
                 f"screenshot {shots[1]}", material, "edit", set_text(BROKEN), f"screenshot {self.folder}/last_good.png",
                 set_text(GOOD), f"screenshot {shots[2]}"]
        script = self.folder / "tour.txt"
        script.write_text("\n".join(lines) + "\n")
        done = subprocess.run([PROGRAM, self.copy(scene), "--headless", "--script", script, *OPTIONS], capture_output=True, text=True,
                              timeout=300)
        self.assertIn(done.returncode, (0, 1), done.stderr)  # the broken text is a finding
        self.assertNotIn("tour.txt", done.stderr)
        self.assertEqual(png.read(self.folder / "last_good.png"), png.read(shots[1]), "a broken text changed the picture")
        return side_by_side(shots)

    def scenes(self):
        return MINE + [scene for scene in OTHERS if scene.exists()]

    def test_by_script(self):
        for scene in self.scenes():
            with self.subTest(scene.stem):
                shutil.rmtree(self.folder / "scene", ignore_errors=True)
                rows = self.by_script(scene, select(scene))
                if os.environ.get("KINORA_WRITE_GOLDENS"):
                    GOLDENS.mkdir(exist_ok=True)
                    png.write(GOLDENS / f"{scene.stem}.png", 3 * WIDTH, HEIGHT, rows)
                self.check(scene, rows)


if __name__ == "__main__":
    main()
