#!/usr/bin/env python3
"""tests/programs/play/play_commands_test.py: each row of the table of commands, by its real key, menu entry or name
in a window, and by its word without one: the same state, the same pixels, and what the row says has changed.

One window and one script go through all rows. The window takes lines from its standard input, for what is not
tested; --record says when it has done something, so that nothing waits for a time."""
import json
import re
import shutil
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
import display as displays
from programs import BIN, SOURCE

PROGRAM = BIN / "kinora-play"
WALKER, BENDER = "assets/scenes/walker.dae", "assets/gltf/bender.glb"
FILES = (WALKER, BENDER, "assets/scenes/matte.dae")
OPTIONS = ("--size", "64x36", "--spp", "2", "--threads", "2")
SUBJECTS = {"Camera": "camera", "Time": "time", "Playback": "playback", "Picture": "picture", "Selection": "selection",
            "Shader": "shader", "Scene": "scene", "Panels": "panels", "File": "files", "Quit": "quit"}
KEYS = {"[": "bracketleft", "]": "bracketright", "Space": "space"}  # others are xdotool's own names


class Row:
    def __init__(self, texts, changes):
        self.keys, self.menu, self.arguments, example, self.setup = texts[:5]
        self.example, self.changes = example.replace("$TMP/", ""), changes


def rows():
    """The rows of commands.def by word."""
    text = (SOURCE / "runtime/player/commands.def").read_text()
    string = r'"((?:[^"\\]|\\.)*)"'
    pattern = r"^COMMAND\((\w+), " + ", ".join([string] * 5) + r", (\w+), " + string + r"\)$"
    found = {}
    for word, *texts, changes, _ in re.findall(pattern, text, re.M):
        found[word] = Row([json.loads(f'"{t}"') for t in texts], changes)
    assert len(found) == len(re.findall(r"^COMMAND\(", text, re.M)), "a row is not understood"
    return found


def xdotool_key(name):
    *modifiers, key = name.split()[0].split("+")
    return "+".join([m.lower() for m in modifiers] + [KEYS.get(key, key.lower() if len(key) == 1 else key)])


class Session:
    """A window that is told lines."""

    def __init__(self, display, folder):
        self.record, self.folder, self.display = folder / "record.txt", folder, display
        self.window = displays.Window(display, PROGRAM, WALKER, *OPTIONS, "--record", "record.txt", "--script", "-", cwd=folder,
                                      stdin=subprocess.PIPE)
        self.window.appear()
        self.lines = []  # said so far, for the script

    def say(self, *lines):
        """Lines, and what they write last is there."""
        self.lines += lines
        self.window.process.stdin.write("".join(line + "\n" for line in lines))
        self.window.process.stdin.flush()

    def count(self, word):
        return len(re.findall(rf"^{word}\b", self.record.read_text(), re.M))

    def state(self, name):
        self.say(f"state {name}.json")
        self.window.recorded(self.record, rf"^state {re.escape(name)}\.json$")
        return json.loads((self.folder / f"{name}.json").read_text())

    def settle(self):
        """Some turns of the window, so that ImGui has laid out what has just come."""
        self.say("wait 0.2")
        del self.lines[-1]
        self.state(f"settled{len(self.lines)}")

    def act(self, word, row, menus):
        """The row by its key, its menu entry, or its name; and as a line of a script."""
        done = self.count(word)
        line = f"{word} {row.example}".strip()
        if row.keys and row.arguments and not row.arguments.startswith("["):
            opened = self.count("commands")
            self.window.key(xdotool_key(row.keys))  # the palette waits for the arguments
            self.window.recorded(self.record, "^commands$", opened + 1)
            self.finish_line(line, line.split(" ", 1)[1])
        elif row.keys:
            self.window.key(xdotool_key(row.keys))
            self.lines.append(word)
        elif row.menu:
            self.click_menu(row.menu, menus)
            self.lines.append(word)
        else:
            opened = self.count("commands")
            self.window.key("ctrl+p")
            self.window.recorded(self.record, "^commands$", opened + 1)
            self.finish_line(line, line)
        self.window.recorded(self.record, rf"^{word}\b", done + 1)

    def opened_menu(self, before, x):
        """The first and the last line of the menu that opens under its title, as soon as it is drawn and stays. What
        changes far below it, as a message that goes, is none of it."""
        width, last = self.display.width, None
        end = time.monotonic() + 60
        while time.monotonic() < end:
            now = self.display.rgb()
            changed = [y for y in range(24, self.display.height) if before[3 * (y * width + x):3 * (y * width + x) + 60] !=
                       now[3 * (y * width + x):3 * (y * width + x) + 60]]
            menu = changed[:1]
            for y in changed:
                if y - menu[-1] < 30:
                    menu.append(y)
            if menu and menu == last and menu[-1] - menu[0] > 30:
                return menu[0], menu[-1]
            last = menu
            time.sleep(0.15)
        raise AssertionError("no menu opens")

    def finish_line(self, line, typed):
        """The palette is open: what is typed makes it that line."""
        closed = self.count("panel commands")
        self.settle()
        self.window.type(typed)
        self.window.key("Return")
        self.lines += ["commands", line, "panel commands"]
        self.window.recorded(self.record, "^panel commands$", closed + 1)

    def click_menu(self, path, menus):
        """The title is the menu's place among the words of the bar, the entry its place in the menu."""
        menu, entry = path.split("/")
        width = self.display.width
        self.settle()  # the panels of a scene just opened are drawn, and are none of the menu
        rgb = self.display.rgb()
        ground = rgb[3 * (4 * width + 2):3 * (4 * width + 3)]
        inked = [any(rgb[3 * (y * width + x):3 * (y * width + x) + 3] != ground for y in range(4, 18)) for x in range(600)]
        words, gap = [], 99
        for x, ink in enumerate(inked):
            if ink and gap > 6:
                words.append([x, x])
            if ink:
                words[-1][1] = x
            gap = 0 if ink else gap + 1
        x = sum(words[list(menus).index(menu)]) // 2
        self.window.click(x, 10)
        top, bottom = self.opened_menu(rgb, x)
        entries = menus[menu]
        self.window.click(x + 8, top + (bottom - top) * (2 * entries.index(entry) + 1) // (2 * len(entries)))


def menus_of(table):
    """Entries by menu, in the order of the bar."""
    found = {}
    for row in table.values():
        if row.menu:
            menu, entry = row.menu.split("/")
            found.setdefault(menu, []).append(entry)
    rank = {"File": 0, "Edit": 1, "View": 2, "Window": 4, "Help": 5}
    return dict(sorted(found.items(), key=lambda item: rank.get(item[0], 3)))


class CommandsTest(unittest.TestCase):
    maxDiff = None

    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix="kinora_commands_"))
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)
        for side in ("window", "script"):
            for file in FILES:
                (self.folder / side / file).parent.mkdir(parents=True, exist_ok=True)
                shutil.copy(SOURCE / file, self.folder / side / file)

    def in_window(self, session, table):
        """All rows; what was seen before and after each."""
        menus, seen, opened = menus_of(table), {}, ""
        first = session.state("first")
        kept = [panel for panel in first["panels"].split() if panel != "editor"]
        session.say(*(f"panel {panel}" for panel in first["panels"].split() if panel not in kept))
        for word, row in table.items():
            if word == "quit":
                continue
            scene = BENDER if word == "clip" else WALKER
            if scene != opened:
                session.say("open " + scene)
            session.say("wait refined", *filter(None, map(str.strip, row.setup.split(";"))), "wait refined")
            # What these change is none of the scene's.
            opened = scene if row.changes in ("Picture", "Panels") else ""
            before = session.state(f"{word}_before")
            session.act(word, row, menus)
            session.say("wait picture")
            after = session.state(f"{word}_after")
            stands = after["playback"].startswith("stands")
            timeless = stands and before["playback"].startswith("stands")
            if timeless:  # else the picture is of a time that the clock chose
                session.say("wait refined", f"screenshot {word}.shot.png")
                session.window.recorded(session.record, rf"^screenshot {word}\.shot\.png$")
            if row.changes == "Panels":
                session.say(f"{word} {row.example}".strip())  # as it was before
            else:  # an open editor opens the shader of what is selected by itself
                session.say(*(f"panel {p}" for p in after["panels"].split() if p not in kept))
            seen[word] = before, after
        return first, seen

    def same(self, a, b, subject):
        self.assertEqual(*(re.sub(r"^scene \d+ of ", "", state[subject]) for state in (a, b)), subject)

    def test_each_row_by_key_and_by_word(self):
        table = rows()
        with displays.Display(1280, 800) as display:
            session = Session(display, self.folder / "window")
            self.addCleanup(session.window.close)
            first, seen = self.in_window(session, table)
            quit_key = xdotool_key(table["quit"].keys)
            session.window.key(quit_key)
            self.assertEqual(session.window.process.wait(30), 0, session.window.process.stderr.read())
            self.assertRegex(session.record.read_text(), r"\nquit\n$")
        panels = [f"panel {name}" for name in first["panels"].split()]
        script = self.folder / "script/script.txt"
        script.write_text("\n".join(panels + session.lines + ["quit", "state quit.json"]) + "\n")
        done = subprocess.run([PROGRAM, WALKER, "--headless", "--script", script.name, *OPTIONS], cwd=script.parent, capture_output=True,
                              text=True, timeout=600)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(json.loads((script.parent / "quit.json").read_text())["quit"], "ends")
        for word, row in table.items():
            if word == "quit":
                continue
            with self.subTest(word):
                before, after = seen[word]
                subject = SUBJECTS[row.changes]
                self.assertNotEqual(before[subject], after[subject])
                headless = [json.loads((script.parent / f"{word}_{when}.json").read_text()) for when in ("before", "after")]
                self.assertNotEqual(headless[0][subject], headless[1][subject])
                # What the clock has changed is not compared.
                timeless = all(state["playback"].startswith("stands") for state in (before, after))
                for shown, scripted in zip((before, after), headless):
                    for name in shown:
                        if timeless or name not in ("time", "camera"):
                            self.same(shown, scripted, name)
                shots = [self.folder / side / f"{word}.shot.png" for side in ("window", "script")]
                self.assertEqual(shots[0].exists(), timeless)
                if shots[0].exists():
                    self.assertEqual(shots[0].read_bytes(), shots[1].read_bytes(), "other pixels")


if __name__ == "__main__":
    if not PROGRAM.exists() or displays.missing():
        print("skipped: needs", ", ".join(displays.missing() or [str(PROGRAM)]))
        sys.exit(77)
    unittest.main(verbosity=2)
