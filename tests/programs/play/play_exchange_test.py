#!/usr/bin/env python3
"""tests/programs/play/play_exchange_test.py: what other programs hand to kinora-play's window: files dropped on it, texts on the
clipboard, both ways; and letters beyond ASCII."""
import re
import shutil
import sys
import tempfile
import time
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
import display as displays
import x_client
from programs import BIN, MATTE, SCENES

PROGRAM = BIN / "kinora-play"
SMALL = ("--size", "64x36", "--threads", "2")


class ExchangeTest(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix="kinora_exchange_"))
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)
        self.display = self.enterContext_(displays.Display(1280, 800))
        self.client = self.enterContext_(x_client.Client(self.display))

    def enterContext_(self, manager):
        entered = manager.__enter__()
        self.addCleanup(manager.__exit__, None, None, None)
        return entered

    def open(self, scene, script=""):
        self.record = self.folder / "record.txt"
        (self.folder / "script.txt").write_text(script + "state begun.json\n")
        window = displays.Window(self.display, PROGRAM, scene, *SMALL, "--record", self.record, "--script", self.folder / "script.txt",
                                 cwd=self.folder)
        self.addCleanup(window.close)
        window.appear()
        window.recorded(self.record, "^state begun")
        return window

    def end(self, window):
        window.key("ctrl+q")
        self.assertEqual(window.process.wait(30), 0, window.process.stderr.read())
        return self.record.read_text()

    def test_a_scene_is_dropped(self):
        """Its name has a space and letters that a URI writes as numbers."""
        other = self.folder / "another scene ä.dae"
        shutil.copy(MATTE, other)
        window = self.open(SCENES / "walker.dae", "wait picture\n")
        self.client.drop(window.id, 500, 300, [other])
        self.assertIn(f'open "{other}"', window.recorded(self.record, "^open "))
        # Nothing of a scene that is missing; the one shown stays.
        self.client.drop(window.id, 500, 300, [self.folder / "missing.dae"])
        window.recorded(self.record, "^open ", 2)
        self.end(window)

    def test_texts_come_and_go_by_the_clipboard(self):
        window = self.open(MATTE, "wait picture\nselect_material bright\nedit\nwait picture\n")
        window.click(1000, 300)
        window.wait_still(20, 0.5)
        window.key("ctrl+a")
        text = 'surface pasted() { /* ä → π */ Ci = color(0, 1, 0); Oi = 1; }\n'
        self.client.copy(text)
        window.key("ctrl+v")
        recorded = window.recorded(self.record, r"^set_text .*pasted\(")
        self.assertIn('"surface pasted() { /* ä → π */ Ci = color(0, 1, 0); Oi = 1; }', recorded)
        self.client.copy("something else")
        window.key("ctrl+a", "ctrl+c")
        end = time.monotonic() + 30
        while (copied := self.client.paste()) == "something else" and time.monotonic() < end:
            time.sleep(0.05)
        self.assertEqual(copied.strip(), text.strip())
        self.end(window)


if __name__ == "__main__":
    if not PROGRAM.exists() or displays.missing():
        print("skipped: needs", ", ".join(displays.missing() or [str(PROGRAM)]))
        sys.exit(77)
    unittest.main(verbosity=2)
