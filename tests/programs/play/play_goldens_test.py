#!/usr/bin/env python3
"""tests/programs/play/play_goldens_test.py: a tour of each scene, in a window with real keys and a real mouse, and by a
script without one: both show the pictures of tests/programs/goldens, within a tolerance.

Three pictures a scene side by side: moved by hand; played, then another frame; its shader changed. KINORA_WRITE_GOLDENS=1
writes them from the script; look at them before they are committed."""
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
import display as displays
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

    def in_window(self, display, scene, material):
        """The same by keys and mouse; what has neither is said on standard input."""
        shutil.rmtree(display.folder / "config", ignore_errors=True)
        record, shots = self.folder / "record.txt", [self.folder / f"w{k}.png" for k in range(3)]
        copy = self.copy(scene)
        window = displays.Window(display, PROGRAM, copy, *OPTIONS, "--record", record, "--script", "-", stdin=subprocess.PIPE)
        self.addCleanup(window.close)
        window.appear()

        def say(*lines):
            window.process.stdin.write("".join(line + "\n" for line in lines))
            window.process.stdin.flush()

        def shot(path):
            say("wait refined", f"screenshot {path}")
            window.recorded(record, rf"^screenshot {re.escape(str(path))}$", seconds=200)
        shot(self.folder / "opened.png")
        window.drag(500, 300, 440, 330)  # 0.4 degrees a pixel
        window.recorded(record, "^orbit ")
        shot(shots[0])
        window.key("space")
        window.recorded(record, "^play$")
        window.drag(300, 755, 600, 755)  # the timeline
        window.recorded(record, "^seek ")
        window.key("space")
        window.recorded(record, "^play$", 2)
        window.key("Home", "Right", "Right")
        window.recorded(record, "^next$", 2)
        shot(shots[1])
        say(material, "edit", "caret 1 1")
        window.recorded(record, "^caret ")
        window.click(1000, 300)  # the editor
        window.key("ctrl+a")
        display.xdotool("key", "Delete")
        window.type(BROKEN)
        window.recorded(record, rf"^set_text .*{re.escape(BROKEN[-12:])}", seconds=120)
        shot(self.folder / "last.png")
        self.assertEqual(png.read(self.folder / "last.png"), png.read(shots[1]), "a broken text changed the picture")
        say(set_text(GOOD))
        shot(shots[2])
        window.click(560, 360)
        window.recorded(record, "^click ")
        window.key("Escape", "ctrl+q")
        self.assertEqual(window.process.wait(30), 0)
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

    def test_in_a_window(self):
        if displays.missing():
            self.skipTest("needs " + ", ".join(displays.missing()))
        with displays.Display(1280, 800) as display:
            for scene in self.scenes():
                with self.subTest(scene.stem):
                    shutil.rmtree(self.folder / "scene", ignore_errors=True)
                    (self.folder / "record.txt").unlink(missing_ok=True)
                    self.check(scene, self.in_window(display, scene, select(scene)))


if __name__ == "__main__":
    main()
