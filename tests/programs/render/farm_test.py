"""tests/programs/render/farm_test.py: what a farm does to kinora-render and what it reads of it."""
import json
import os
import re
import shutil
import signal
import subprocess
import sys
import time
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from programs import MATTE, TIMEOUT, ProgramTest, command, main, render
from written_scenes import (CAMERA, EYE, WHITE, MATTE as LAMBERT, SceneTest, animation, animations, document, geometries,
                            place, rsl, square)

SMALL = ("--size", "24x16", "--spp", "1", "--threads", "1")
LONG = ("--size", "96x64", "--spp", "64", "--threads", "1")  # frames that take a while


def last_line(text):
    return text.strip().splitlines()[-1]


def states(result):
    return {frame["frame"]: frame["state"] for frame in json.loads(result.out)["frames"]}


class Run(ProgramTest):
    def start(self, *words):
        return subprocess.Popen(command("kinora-render", *words), stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)

    def wait_for(self, condition):
        deadline = time.monotonic() + TIMEOUT
        while not condition():
            self.assertLess(time.monotonic(), deadline)
            time.sleep(0.005)

    def ended(self, process):
        out, err = process.communicate(timeout=TIMEOUT)
        return process.returncode, out, err


class Folders(Run):
    def removed(self, *words):
        """A run of 30 frames whose folder goes after the third."""
        folder = self.folder / "out"
        process = self.start(MATTE, "-o", folder / "f.####.png", "--frames", "1-30", *LONG, "--progress", "none", "-v", *words)
        self.wait_for((folder / "f.0003.png").exists)  # the second is known to be written
        os.rename(folder, self.folder / "elsewhere")
        code, out, err = self.ended(process)
        self.assertFalse(folder.exists())  # not made again
        self.assertEqual(code, 6, err)
        for frame in (1, 2):
            self.assertRegex(err, rf"f\.000{frame}\.png' was written or kept, and is not there any more")
        return last_line(err)

    def test_one_that_is_removed_in_mid_run_is_exit_6_and_its_frames_are_named(self):
        self.assertRegex(self.removed(), r"^0 of 30 frames; failed: 1-\d+; aborted: \d+-30$")

    def test_so_it_is_when_the_run_keeps_going(self):
        self.assertEqual(self.removed("--keep-going"), "0 of 30 frames; failed: 1-30")

    def test_one_that_goes_before_the_first_frame_is_exit_6_too(self):
        folder = self.folder / "out"
        process = self.start(MATTE, "-o", folder / "f.####.png", "--frames", "1-3", "--keep-going", "--size", "640x360",
                             "--spp", "64", "--threads", "1")
        self.wait_for(folder.exists)
        os.rename(folder, self.folder / "elsewhere")
        code, out, err = self.ended(process)
        self.assertEqual((code, last_line(err)), (6, "0 of 3 frames; failed: 1-3"), err)

    def test_a_picture_that_is_removed_is_named(self):
        process = self.start(MATTE, "-o", self.folder / "f.####.exr", "--frames", "1-12", *LONG, "--stats=json")
        self.wait_for((self.folder / "f.0003.exr").exists)
        (self.folder / "f.0002.exr").unlink()
        code, out, err = self.ended(process)
        self.assertEqual((code, last_line(err)), (6, "11 of 12 frames; failed: 2"), err)
        self.assertIn("f.0002.exr' was written or kept", err)
        self.assertEqual([frame["frame"] for frame in json.loads(out)["frames"] if frame["state"] != "done"], [2])

    def test_a_kept_one_too(self):
        words = (MATTE, "-o", self.folder / "f.####.png", "--frames", "1-9", *LONG, "--skip-existing")
        self.expect(render(*words[:4], "1,9", *words[5:]), 0)
        process = self.start(*words)
        self.wait_for((self.folder / "f.0003.png").exists)
        (self.folder / "f.0001.png").unlink()
        code, out, err = self.ended(process)
        self.assertEqual((code, last_line(err)), (6, "8 of 9 frames; failed: 1"), err)


class Report(Run):
    def frames(self, *words):
        return render(MATTE, "-o", self.folder / "f.####.png", "--frames", "1-3", *SMALL, "--stats=json", *words)

    def test_each_frame_is_done_or_kept(self):
        result = self.expect(self.frames(), 0)
        self.assertEqual(states(result), {1: "done", 2: "done", 3: "done"})
        self.assertEqual(last_line(result.err), "3 of 3 frames")
        (self.folder / "f.0002.png").unlink()
        result = self.expect(self.frames("--skip-existing"), 0)
        self.assertEqual(states(result), {1: "kept", 2: "done", 3: "kept"})
        self.assertEqual(last_line(result.err), "3 of 3 frames")

    def test_or_failed_or_aborted(self):
        (self.folder / "f.0002.png").mkdir()
        result = self.expect(self.frames(), 6)
        self.assertEqual(states(result), {1: "done", 2: "failed", 3: "aborted"})
        self.assertEqual(last_line(result.err), "1 of 3 frames; failed: 2; aborted: 3")
        result = self.expect(self.frames("--keep-going"), 1)
        self.assertEqual(states(result), {1: "done", 2: "failed", 3: "done"})
        self.assertEqual(last_line(result.err), "2 of 3 frames; failed: 2")
        result = self.expect(self.frames("-q"), 6)
        self.assertEqual(last_line(result.err), "1 of 3 frames; failed: 2; aborted: 3")

    def test_a_signal_aborts_the_frame_under_way_and_those_behind_it(self):
        process = self.start(MATTE, "-o", self.folder / "f.####.png", "--frames", "1-500", *LONG, "--stats=json", "-q")
        self.wait_for((self.folder / "f.0002.png").exists)
        process.send_signal(signal.SIGTERM)
        code, out, err = self.ended(process)
        self.assertEqual(code, 143, err)
        frames = json.loads(out)["frames"]
        done = [frame["frame"] for frame in frames if frame["state"] == "done"]
        self.assertEqual(done, sorted(int(file.stem[2:]) for file in self.folder.glob("f.*.png")))
        self.assertEqual([frame["state"] for frame in frames], ["done"] * len(done) + ["aborted"] * (500 - len(done)))
        self.assertEqual(last_line(err), f"{len(done)} of 500 frames; aborted: {len(done) + 1}-500")

    def test_a_frame_that_two_ranges_name_is_rendered_once(self):
        words = (MATTE, "-o", self.folder / "f.####.png", "--frames", "1-3,2-4", *SMALL, "--stats=json")
        self.assertEqual(list(states(self.expect(render(*words), 0))), [1, 2, 3, 4])

    def test_quiet_keeps_progress_that_was_asked_for(self):
        words = (MATTE, "-o", self.folder / "f.####.png", "--frames", "1-2", *SMALL, "-q")
        self.assertEqual(render(*words).err, "")
        said = self.expect(render(*words, "--progress", "lines"), 0).err
        self.assertEqual(re.findall(r"^frame (\d) \((\d)/2\)", said, re.M), [("1", "1"), ("2", "2")], said)
        self.assertIn("100%", render(*words, "--progress", "bar").err)
        self.assertEqual(render(*words, "--progress", "none").err, "")

    def test_threads_are_those_of_the_affinity(self):
        one = sorted(os.sched_getaffinity(0))[:1]
        words = (MATTE, "-o", "null", "--size", "8x8", "--spp", "1", "--stats=json")
        result = render(*words, preexec_fn=lambda: os.sched_setaffinity(0, one))
        self.assertEqual(json.loads(self.expect(result, 0).out)["threads"], 1)
        result = render(*words, "--threads", "3", preexec_fn=lambda: os.sched_setaffinity(0, one))
        self.assertEqual(json.loads(self.expect(result, 0).out)["threads"], 3)


class Range(SceneTest):
    TEXT = document(CAMERA + WHITE + geometries(square()) + animations(animation("a", "node/t.X", [0, 1], [0, 1])),
                    EYE + place('<translate sid="t">0 0 0</translate>'))
    SAID = "frames past the animated range"

    def test_frames_past_it_get_one_warning(self):
        result = self.render(self.TEXT, "--frames", "20-30", out="f.####.png")
        self.assertEqual(result.err.count(self.SAID), 1, result)
        self.assertIn("which is 0 to 24: 25-30", result.err)
        self.assertIn("which is 0 to 24: 72", self.render(self.TEXT, "--time", "3").err)
        result = self.render(self.TEXT, "--frames", "-2-13x5", "--fps", "12", out="f.####.png")
        self.assertIn("which is 0 to 12: 13", result.err)
        self.render(self.TEXT, "--frames", "30", "--fail-on", "warning", code=1)

    def test_others_get_none(self):
        still = document(CAMERA + WHITE + geometries(square()), EYE + place())
        for text, words in ((self.TEXT, ("--frames", "-9-24x3")), (self.TEXT, ()), (self.TEXT, ("--time", "1")),
                            (self.TEXT, ("--turntable", "40", "--camera", "auto")),
                            (still, ("--frames", "7-9")), (still, ("--time", "100"))):
            self.assertNotIn(self.SAID, self.render(text, *words, out="f.####.png").err, words)


class DefaultLights(SceneTest):
    TEXT = document(CAMERA + LAMBERT + geometries(square()), EYE + place())

    def lights(self, text, *words):
        listed = self.expect(render(self.write("scene.dae", text), "--list", "lights", *words), 0).out
        return [name for name in ("key", "fill", "rim") if f"default {name} light" in listed]

    def test_can_be_hidden_by_name(self):
        self.assertEqual(self.lights(self.TEXT), ["key", "fill", "rim"])
        for pattern, left in (("default key light", ["fill", "rim"]), ("*rim*", ["key", "fill"]),
                              ("default light", []), ("default*", [])):
            self.assertEqual(self.lights(self.TEXT, "--hide", pattern), left, pattern)
        self.assertEqual(self.lights(self.TEXT, "--hide", "*fill light", "--hide", "default key light"), ["rim"])

    def test_the_picture_is_without_their_light(self):
        self.render(self.TEXT)
        whole = self.pixel()[0]
        parts = []
        for others in (("fill", "rim"), ("key", "rim"), ("key", "fill")):
            self.render(self.TEXT, *(word for name in others for word in ("--hide", f"default {name} light")))
            parts.append(self.pixel()[0])
        self.assertLess(max(parts), whole)
        self.assertAlmostEqual(sum(parts), whole, delta=3)  # light adds up; bytes are rounded
        result = self.render(self.TEXT, "--hide", "default*", "--param", "default key light.intensity=2")
        self.assertEqual(self.pixel(), (0, 0, 0), result)

    def test_names_that_a_scene_does_not_add_are_no_error(self):
        lit = self.TEXT.replace("<library_visual", '<library_lights><light id="l"><technique_common><ambient><color>1 1 1'
                                '</color></ambient><directional><color>1 1 1</color></directional></technique_common>'
                                "</light></library_lights><library_visual").replace("<ambient><color>1 1 1</color></ambient>", "")
        lit = lit.replace('<node id="eye">', '<node id="sun"><instance_light url="#l"/></node><node id="eye">')
        self.render(lit)
        before = self.bytes_of("a.png")
        self.render(lit, "--hide", "default key light", "--hide", "grey world")
        self.assertEqual(self.bytes_of("a.png"), before)
        self.render(lit, "--hide", "default lamp", code=2)


class Shards(SceneTest):
    # A displaced square comes into view at 0.5 s: `draft` bends its normals alone.
    CODE = "displacement d() { P += 0.6 * sin(20 * u) * sin(17 * v) * vector(0, 0, 1); N = calculatenormal(P); }"

    def test_settings_for_an_error_are_those_of_the_shot(self):
        text = rsl("surface s() { Ci = normalize(N) . normalize(I); Ci *= Ci; Oi = 1; }" + self.CODE)
        text = text.replace("</pass>", '</pass><pass><shader stage="DISPLACEMENT"/></pass>')
        moved = animation("a", "node/t.X", [0, 0.5, 1], [-50, 0, 0], interpolation="STEP")
        scene = self.write("scene.dae", document(CAMERA + text + geometries(square()) + animations(moved),
                                                 EYE + place('<translate sid="t">0 0 0</translate>')))
        said = {}
        for frames in ("0-4x2", "14-24x10", "24"):
            folder = self.folder / frames
            result = render(scene, "-o", folder / "f.##.png", "--frames", frames, "--size", "24x24", "--camera", "cam",
                            "--target-error", "rmse:0.05", "--threads", "2", "--progress", "none")
            said[frames] = re.search(r"settings of .*", self.expect(result, 0).err).group()
        self.assertEqual(len(set(said.values())), 1, said)
        self.assertEqual((self.folder / "14-24x10/f.24.png").read_bytes(), (self.folder / "24/f.24.png").read_bytes())


def may_unshare(*words):
    """Whether this machine can be made to look like several."""
    if not shutil.which("unshare"):
        return False
    return subprocess.run(["unshare", *words, "true"], capture_output=True).returncode == 0


CONTAINER = ("--uts", "--pid", "--fork", "--kill-child")


@unittest.skipUnless(may_unshare(*CONTAINER), "unshare is not permitted: one machine cannot be two")
class Hosts(Run):
    """Two containers that share a folder: other hosts, and each program has the process number 1."""

    def on(self, host, *words):
        line = " ".join(f"'{word}'" for word in command("kinora-render", *words))
        return subprocess.Popen(["unshare", *CONTAINER, "sh", "-c", f"hostname {host} && exec {line}"],
                                stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)

    def temporaries(self):
        return [file for file in self.folder.glob(".*.tmp")]

    def killed(self, host):
        """What is left of a run that was killed while it wrote a picture, or two."""
        before = set(self.temporaries())
        for _ in range(100):
            process = self.on(host, MATTE, "-o", self.folder / "f.####.png", "--size", "640x480", "--quality", "draft",
                              "--frames", "1-999", "-q")
            self.wait_for(lambda: set(self.temporaries()) - before)
            process.kill()  # --kill-child: the program, too
            process.communicate(timeout=TIMEOUT)
            if left := set(self.temporaries()) - before:
                return sorted(left)
        self.fail("whatever the moment, nothing was left")

    def test_both_finish_and_nothing_is_left(self):
        words = (MATTE, "-o", self.folder / "f.####.png", "--frames", "1-12", "--size", "64x48", "--spp", "4", "--threads",
                 "1", "-q")
        whole = self.folder / "whole"
        self.expect(render(words[0], "-o", whole / "f.####.png", *words[3:]), 0)
        for process in [self.on("east", *words), self.on("west", *words)]:
            self.assertEqual(self.ended(process), (0, "", ""))
        self.assertEqual(self.pictures(), self.pictures(whole))

    def test_names_tell_who_wrote_and_age_alone_removes(self):
        east, west = self.killed("east"), self.killed("west.farm")
        boot = Path("/proc/sys/kernel/random/boot_id").read_text()[:8]
        for left, host in ((east, "east"), (west, "west-farm")):
            for file in left:
                self.assertRegex(file.name, rf"^\.f\.0\d+\.png\.kinora\.{host}\.{boot}\.1\.[0-9a-f]{{16}}\.tmp$")
        again = (MATTE, "-o", self.folder / "a.png", *SMALL, "-q")
        self.assertEqual(self.ended(self.on("west.farm", *again))[0], 0)
        self.assertEqual(sorted(self.temporaries()), sorted(east + west))  # whose process number is the new run's
        day = 24 * 3600
        for left, age in ((east, day + 60), (west, day - 600)):
            for file in left:
                os.utime(file, (time.time() - age,) * 2)
        self.assertEqual(self.ended(self.on("north", *again))[0], 0)
        self.assertEqual(sorted(self.temporaries()), west)


if __name__ == "__main__":
    main()
