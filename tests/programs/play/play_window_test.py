#!/usr/bin/env python3
"""tests/programs/play/play_window_test.py: kinora-play in a window, with real keys and a real mouse."""
import json
import os
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
import x_probe
from programs import BIN, MATTE, SCENES, SOURCE

PROGRAM = BIN / "kinora-play"


def changed(before, after, box, width):
    """How many pixels of a box differ."""
    x0, y0, x1, y1 = box
    count = 0
    for y in range(y0, y1):
        a, b = before[3 * (y * width + x0):3 * (y * width + x1)], after[3 * (y * width + x0):3 * (y * width + x1)]
        if a != b:
            count += sum(a[i:i + 3] != b[i:i + 3] for i in range(0, len(a), 3))
    return count


PICTURE = (232, 24, 888, 700)  # of a window of 1280 x 800 with its first layout
TIMELINE = (232, 704, 888, 775)


class WindowTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.display = displays.Display(1280, 800)

    @classmethod
    def tearDownClass(cls):
        cls.display.close()

    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix="kinora_window_"))
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)
        shutil.rmtree(self.display.folder / "config", ignore_errors=True)

    def open(self, scene, *words, **options):
        self.record = self.folder / "session.txt"
        window = displays.Window(self.display, PROGRAM, scene, "--record", self.record, *words, **options)
        self.addCleanup(window.close)
        window.appear()
        return window

    def words(self, window):
        """The commands of the session, as recorded: the window is closed."""
        window.key("ctrl+q")
        self.assertEqual(window.process.wait(20), 0, window.process.stderr.read())
        return self.record.read_text()

    def eventually(self, condition, what, seconds=20):
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            if condition():
                return
            time.sleep(0.1)
        self.fail(what)

    def command(self, window, line):
        """A line in the palette; it is done when this returns."""
        opened = len(re.findall("^commands$", self.record.read_text(), re.M))
        window.key("ctrl+p")
        window.recorded(self.record, "^commands$", opened + 1)
        window.wait_still(10, 0.3)  # laid out, with the caret in it
        window.type(line)
        window.key("Return")
        window.recorded(self.record, "^panel commands$", opened + 1)

    def drawn(self, box, seconds=30):
        """Until something is in the picture's box beside the empty stage."""
        def some():
            rgb = self.display.rgb()
            x0, y0, x1, y1 = box
            colors = {rgb[3 * (y * 1280 + x):3 * (y * 1280 + x) + 3] for y in range(y0, y1, 16) for x in range(x0, x1, 16)}
            return len(colors) > 12
        self.eventually(some, "no picture", seconds)

    def test_mouse_and_keys_become_commands(self):
        window = self.open(SCENES / "tintoy.dae")
        self.drawn(PICTURE)
        window.drag(500, 300, 560, 330)
        window.drag(500, 300, 540, 300, button=2)
        window.click(560, 360)
        self.display.xdotool("mousemove", 560, 360, "click", 4)
        window.key("Right", "Right", "f", "bracketright")
        window.drag(300, 755, 600, 755)
        window.key("space")
        window.recorded(self.record, "^play$")
        window.key("space")
        window.recorded(self.record, "^play$", 2)
        self.display.xdotool("keydown", "shift")
        window.drag(500, 300, 540, 320)
        self.display.xdotool("keyup", "shift")
        window.recorded(self.record, r"^pan -?0\.\d+ 0\.\d+$")  # the one before went right alone
        self.display.xdotool("mousemove", 540, 340, "click", 2)
        window.recorded(self.record, r"^pivot \d+ \d+$")
        window.drag(500, 300, 500, 340, button=3)
        window.recorded(self.record, "^dolly ", 2)  # one was the wheel's
        text = self.words(window)
        for pattern in (r"^orbit -?\d", r"^pan -?0?\.?\d", r"^click \d+ \d+$", r"^dolly 1\.12", r"^next$", r"^frame_all$",
                        r"^brighter$", r"^seek \d+$", r"^play$"):
            self.assertRegex(text, re.compile(pattern, re.M))
        self.assertEqual(len(re.findall(r"^next$", text, re.M)), 2)
        self.assertEqual(len(re.findall(r"^play$", text, re.M)), 2)
        orbits = [tuple(map(float, m)) for m in re.findall(r"^orbit (\S+) (\S+)", text, re.M)]
        self.assertAlmostEqual(sum(right for right, _ in orbits), -0.4 * 60, delta=0.01)
        self.assertAlmostEqual(sum(up for _, up in orbits), 0.4 * 30, delta=0.01)

    def test_a_drag_in_one_go_keeps_its_last_step(self):
        """Press, steps and release lie in the queue together, while every frame takes long."""
        window = self.open(SCENES / "rays.dae")
        self.drawn(PICTURE)
        with x_probe.Hand(self.display) as hand:
            hand.move(500, 300)
            for _ in range(8):
                hand.button(1, True)
                for step in range(5):
                    hand.move(504 + 7 * step, 300 + step)
                hand.move(540, 310)
                hand.button(1, False)
                hand.move(500, 300)
        text = self.words(window)
        turned = [tuple(map(float, m)) for m in re.findall(r"^orbit (\S+) (\S+)", text, re.M)]
        self.assertAlmostEqual(sum(right for right, _ in turned), -0.4 * 40 * 8, delta=0.01)
        self.assertAlmostEqual(sum(up for _, up in turned), 0.4 * 10 * 8, delta=0.01)
        self.assertNotRegex(text, re.compile("^click", re.M))

    def test_the_mouse_looks_flies_and_wipes(self):
        window = self.open(MATTE)
        self.drawn(PICTURE)
        self.display.xdotool("keydown", "ctrl")
        window.drag(500, 300, 560, 330)
        self.display.xdotool("keyup", "ctrl")
        window.recorded(self.record, "^look ")
        # With the right button held, letters move the camera and are no commands.
        self.display.xdotool("mousemove", 560, 300, "mousedown", 3, "keydown", "w", "keydown", "d")
        window.recorded(self.record, r"^fly 0\.\d+ 0 0\.\d+", 3)
        self.display.xdotool("mousemove", 600, 300)
        window.recorded(self.record, "^look ", 2)
        self.display.xdotool("keyup", "w", "keyup", "d", "keydown", "a", "sleep", 0.3, "keyup", "a", "mouseup", 3)
        window.recorded(self.record, r"^fly -0\.\d+ 0 0$")
        window.key("ctrl+k")
        window.recorded(self.record, "^keep$")
        window.wait_still(20, 1)
        middle = (PICTURE[0] + PICTURE[2]) // 2
        window.drag(middle, 400, middle - 150, 400)
        text = window.recorded(self.record, r"^wipe 0\.2\d+$")
        self.assertNotRegex(text, re.compile("^(aov|orbit|dolly)", re.M))
        self.words(window)

    def test_findings_lead_to_their_places(self):
        scene = self.folder / "scene.dae"
        scene.write_text(MATTE.read_text().replace("<library_effects>", "<library_nonsense/>\n<library_effects>", 1))
        window = self.open(scene)
        self.drawn(PICTURE)
        window.key("F8")
        text = window.recorded(self.record, "^finding$")
        self.assertNotIn("panel source", text)  # the command itself opens it
        before = self.display.rgb()
        self.command(window, "select_material bright")
        window.key("ctrl+e")
        window.recorded(self.record, "^edit$")
        self.command(window, 'type "("')
        window.key("ctrl+shift+5")
        window.recorded(self.record, "^show_findings$")
        window.wait_still(20, 1)
        self.assertGreater(changed(before, self.display.rgb(), (888, 60, 1280, 700), 1280), 500)
        window.click(450, 640)  # the first row
        window.recorded(self.record, "^finding 1$")
        self.words(window)

    def test_the_status_line_counts_findings(self):
        """Its colored dot stands where the scene's name ends; a click there lists them."""
        scene = self.folder / "scene.dae"
        scene.write_text(MATTE.read_text().replace('target="#dim"', 'target="#nowhere"', 1))
        window = self.open(scene)
        self.drawn(PICTURE)

        def dot():
            """The first colored pixel of the line."""
            line = self.display.rgb()[3 * 788 * 1280:3 * (788 * 1280 + 600)]
            colors = [line[3 * x:3 * x + 3] for x in range(1, 600)]
            return next((x for x, (red, _, blue) in enumerate(colors, 1) if red > blue + 90), 0)
        self.eventually(dot, "the status line tells no finding")
        window.click(dot() + 2, 788)
        window.recorded(self.record, "^panel findings$")
        self.words(window)

    def test_a_record_leads_to_the_same_state(self):
        """Keys and mouse by the clock, then the record without a window: all that is observed is the same."""
        script = self.folder / "end.txt"
        script.write_text("")
        window = self.open(SCENES / "walker.dae", "--quality", "preview", "--spp", "1", "--size", "96x54", "--script", "-",
                           stdin=subprocess.PIPE)
        self.drawn(PICTURE)
        window.key("space")
        window.recorded(self.record, "^play$")
        window.drag(500, 300, 560, 330)
        window.key("bracketright")
        window.click(560, 330)
        window.recorded(self.record, "^click ")
        window.key("space")
        window.recorded(self.record, "^play$", 2)
        window.key("Right", "shift+c")
        window.recorded(self.record, "^camera_lock$")
        ends = [self.folder / "window.json", self.folder / "script.json"]
        shots = [end.with_suffix(".png") for end in ends]
        window.process.stdin.write(f"wait refined\nscreenshot {shots[0]}\nstate {ends[0]}\n")
        window.process.stdin.flush()
        window.recorded(self.record, "^state ", seconds=90)
        recorded = self.words(window)
        replayed = recorded.replace(str(ends[0]), str(ends[1])).replace(str(shots[0]), str(shots[1]))
        script.write_text(replayed)
        done = subprocess.run([PROGRAM, SCENES / "walker.dae", "--headless", "--script", script, "--quality", "preview", "--spp", "1",
                               "--size", "96x54"], capture_output=True, text=True, timeout=300)
        self.assertEqual(done.returncode, 0, done.stderr)
        states = [json.loads(end.read_text()) for end in ends]
        for subject in states[0]:
            self.assertEqual(*(re.sub(r"^scene \d+ of ", "", state[subject]) for state in states), f"{subject}: {recorded}")
        self.assertEqual(shots[0].read_bytes(), shots[1].read_bytes())

    def test_help_and_palette_find_every_command(self):
        window = self.open(MATTE)
        self.drawn(PICTURE)
        before = self.display.rgb()
        window.key("h")
        self.eventually(lambda: changed(before, self.display.rgb(), PICTURE, 1280) > 100000, "no cheat sheet")
        window.key("h")
        self.command(window, "seek 7")
        self.command(window, "false col")
        text = self.words(window)
        self.assertRegex(text, re.compile(r"^seek 7$", re.M))
        self.assertRegex(text, re.compile(r"^false_color$", re.M))
        self.assertEqual(text.count("\nkeys\n"), 2, text)

    def test_what_is_closed_stays_closed(self):
        window = self.open(MATTE)
        self.drawn(PICTURE)
        window.key("ctrl+shift+3", "ctrl+shift+4")  # shader and pixel: the right area goes
        window.recorded(self.record, "^show_pixel$")
        self.words(window)
        conf = (self.display.folder / "config/kinora/play.conf").read_text()
        self.assertNotRegex(conf, r"panels.*\b(editor|pixel)\b")
        window = self.open(MATTE)
        self.drawn(PICTURE)
        text = self.words(window)
        self.assertNotRegex(text, r"show_editor|panel editor")

    def test_a_splitter_is_dragged(self):
        window = self.open(MATTE)
        self.drawn(PICTURE)
        # From afar, so that one turn of the loop may see the way there and the press.
        self.display.xdotool("mousemove", 700, 300)
        window.wait_still(10, 0.3)
        for words in (("mousemove", 230, 400, "mousedown", 1), ("mousemove", 280, 400), ("mousemove", 330, 400),
                      ("mouseup", 1)):
            self.display.xdotool(*words)
            window.wait_still(10, 0.3)
        self.words(window)  # what it does comes before the window's end
        conf = (self.display.folder / "config/kinora/play.conf").read_text()
        self.assertRegex(conf, r"left 3(2|3)\d")

    def test_a_small_window_is_the_picture(self):
        window = self.open(MATTE)
        self.drawn(PICTURE)
        self.display.xdotool("windowsize", window.id, 320, 240)
        window.wait_still(20, 1)
        window.drag(30, 100, 90, 100)  # where the tree of nodes was, and where the editor
        window.recorded(self.record, "^orbit ")
        window.drag(230, 100, 290, 100)
        text = self.words(window)
        turned = sum(float(right) for right in re.findall(r"^orbit (\S+) ", text, re.M))
        self.assertAlmostEqual(turned, -0.4 * 120, delta=0.01)

    def test_no_opengl_is_mapped(self):
        window = self.open(MATTE)
        self.drawn(PICTURE)
        maps = Path(f"/proc/{window.process.pid}/maps").read_text()
        self.assertNotRegex(maps, r"libGL|libLLVM|libEGL\.|swrast")
        self.assertIn("libSDL2", maps)

    def test_at_rest_it_takes_no_time(self):
        window = self.open(MATTE)
        self.drawn(PICTURE)

        def wakes():
            """How often any of its threads has left a processor."""
            tasks = Path(f"/proc/{window.process.pid}/task").glob("*/status")
            return sum(int(count) for task in tasks for count in re.findall(r"ctxt_switches:\s+(\d+)", task.read_text()))

        def rests():
            before = wakes()
            time.sleep(2)
            return wakes() == before
        self.eventually(rests, "it never comes to rest: the picture is refined, nothing changes", 90)

    def test_resized_and_closed_while_it_loads(self):
        window = self.open(SCENES / "walker.dae")
        self.display.xdotool("windowsize", window.id, 700, 500)
        self.display.xdotool("windowsize", window.id, 500, 330)
        window.key("ctrl+q")
        self.assertEqual(window.process.wait(20), 0)
        window = self.open(MATTE)
        for width, height in ((1200, 700), (480, 320), (1279, 799)):
            self.display.xdotool("windowsize", window.id, width, height)
            time.sleep(0.2)
        self.display.xdotool("windowminimize", window.id)
        self.display.xdotool("windowmap", window.id)
        self.display.xdotool("windowfocus", window.id)
        self.display.xdotool("windowsize", window.id, 1, 1)
        window.key("Right")
        window.recorded(self.record, "^next$")
        self.display.xdotool("windowsize", window.id, 1279, 799)
        self.drawn(PICTURE)
        self.command(window, "seek 3")
        self.assertIn("seek 3", self.words(window))

    def test_a_shader_is_edited(self):
        scene = self.folder / "scene.dae"
        shutil.copy(SCENES / "walker.dae", scene)
        original = scene.read_text()
        window = self.open(scene)
        self.drawn(PICTURE)
        window.click(420, 330)  # the walker: marble
        window.recorded(self.record, "^click ")
        self.eventually(lambda: window.key("ctrl+e") or re.search("^edit$", self.record.read_text(), re.M), "nothing to edit")
        window.click(1000, 300)
        window.key("ctrl+End")
        window.type("float broken(")
        window.recorded(self.record, r"^set_text .*float broken\(")
        window.key("ctrl+a")
        self.display.xdotool("key", "Delete")
        window.type("surface plain() { Ci = color(0, 1, 0); Oi = 1; }")
        window.recorded(self.record, r"^set_text .*Oi = 1; }")
        self.eventually(lambda: window.key("ctrl+s") or re.search("^save$", self.record.read_text(), re.M), "it is not saved")
        text = self.words(window)
        self.assertIn("edit", text)
        self.assertIn("set_text", text)
        self.assertRegex(text, re.compile(r"^save$", re.M))
        self.assertIn("surface plain()", scene.read_text())
        self.assertNotIn("surface plain()", original)

    def test_broken_and_missing_scenes_say_so(self):
        broken = self.folder / "broken.dae"
        broken.write_bytes((SCENES / "walker.dae").read_bytes()[:3000])
        for scene in (broken, self.folder / "missing.dae"):
            with self.subTest(scene.name):
                window = self.open(scene)
                self.eventually(lambda: self.reds() > 20, "nothing red on the screen")
                self.assertIsNone(window.process.poll())
                window.close()

    def reds(self):
        """Pixels of the color that errors have."""
        rgb = self.display.rgb()
        return sum(1 for i in range(0, len(rgb), 3) if rgb[i] == 255 and rgb[i + 1] == 0x6b and rgb[i + 2] == 0x5e)

    def test_scenes_without_meshes_and_without_camera(self):
        text = MATTE.read_text()
        empty, blind = self.folder / "empty.dae", self.folder / "blind.dae"
        empty.write_text(re.sub(r"<instance_geometry.*?</instance_geometry>", "", text, flags=re.S))
        self.assertNotIn("<instance_camera", text)
        blind.write_text(text)
        window = self.open(empty)
        self.eventually(lambda: self.reds() > 20, "an empty scene says nothing")
        # Another one takes its place, as one that is dropped on the window does.
        self.command(window, f"open {blind}")
        self.drawn(PICTURE)
        self.assertRegex(self.words(window), r"\nopen ")

    def test_a_shader_that_loops_for_ever_leaves_the_window_alive(self):
        script = self.folder / "script.txt"
        script.write_text('select_material bright\nedit\nplay on\n'
                          'set_text "surface s(float Ka = 1; float Kd = 1) { float k = 0; while (1) k += 1; Ci = k; Oi = 1; }"\n')
        window = self.open(MATTE, "--script", script)
        window.recorded(self.record, "^set_text ")
        window.key("Tab", "Tab")
        window.recorded(self.record, "^hud$", 2)
        self.words(window)

    PRESSES = 20

    def answers(self, box):
        """Milliseconds from a press of H to the screen that it changes."""
        times, screen = [], x_probe.Screen(self.display)
        with x_probe.Hand(self.display) as hand:
            for _ in range(self.PRESSES):
                before = screen.until_still(box, 0.3)  # laid out; no press is counted twice
                sent = hand.key("h")
                shown = screen.until_changed(box, before, 60)
                self.assertTrue(shown, "the window does not answer")
                times.append(1000 * (shown - sent))
        return sorted(times)

    def frames_ended(self, window, name):
        """When each frame ended so far, by a line of the script."""
        file = self.folder / name
        window.process.stdin.write(f"stats {file}\n")
        window.process.stdin.flush()
        self.eventually(lambda: file.exists() and file.read_text().endswith("}\n"), "no stats", 60)
        return {row["at"] for row in json.loads(file.read_text())["ms"]}

    def test_it_answers_while_a_frame_takes_long(self):
        """Every frame is endless, or one of many rays. Each press changes the screen though fewer frames end meanwhile: a loop
        that waited for the frame would answer once a frame. The times are printed and judge nothing: the processors may be busy."""
        # Without `adapt` no frame is dropped for a smaller one.
        script = ("adapt", "select_material bright", "edit", "play on",
                  'set_text "surface s(float Ka = 1; float Kd = 1) { float k = 0, j; while (1) for (j = 0; j > -1; j += 1) k += u; Ci = k; Oi = 1; }"')
        for scene, words, lines in ((MATTE, (), script), (SCENES / "rays.dae", ("--quality", "final"), ())):
            with self.subTest(scene.name):
                window = self.open(scene, "--script", "-", *words, stdin=subprocess.PIPE)
                self.drawn(PICTURE)
                window.process.stdin.write("".join(line + "\n" for line in lines))
                window.process.stdin.flush()
                if lines:
                    window.recorded(self.record, "^set_text ")
                before = self.frames_ended(window, scene.stem + "_before.json")
                times = self.answers((60, 100, 225, 700))  # the cheat sheet covers the tree of nodes
                ended = self.frames_ended(window, scene.stem + "_after.json") - before
                print(f"{scene.name}: {times[0]:.0f} ms at best, {times[len(times) // 2]:.0f} in the median, {times[-2]:.0f} at p95; "
                      f"{len(ended)} frames ended")
                self.assertLess(len(ended), self.PRESSES)
                self.words(window)
                self.record.unlink()

    def test_a_script_that_fails_says_where(self):
        script = self.folder / "script.txt"
        script.write_text("seek 1\norbitt 3 4\nseek 2\n")
        window = self.open(MATTE, "--script", script)
        window.recorded(self.record, "^seek 1$")
        self.drawn(PICTURE)
        window.key("ctrl+q")
        self.assertEqual(window.process.wait(20), 1)
        self.assertIn("script.txt:2:1: error: there is no command 'orbitt'", window.process.stderr.read())
        self.assertNotIn("seek 2", self.record.read_text())


class WithoutDisplayTest(unittest.TestCase):
    def test_it_points_to_headless(self):
        environment = {k: v for k, v in os.environ.items() if k not in ("DISPLAY", "WAYLAND_DISPLAY", "SDL_VIDEODRIVER")}
        done = subprocess.run([str(PROGRAM), str(MATTE)], env=environment, capture_output=True, text=True, timeout=60)
        self.assertEqual(done.returncode, 2)
        self.assertIn("no display", done.stderr)
        self.assertIn("--headless", done.stderr)


if __name__ == "__main__":
    lacks = displays.missing() + x_probe.missing()
    if not PROGRAM.exists() or lacks:
        print("skipped: needs", ", ".join(lacks or [str(PROGRAM)]))
        sys.exit(77)
    unittest.main(verbosity=2)
