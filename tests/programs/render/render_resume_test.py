"""tests/programs/render/render_resume_test.py: a render that is stopped loses nothing but time."""
import os
import random
import signal
import subprocess
import time
from pathlib import Path
import sys

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from programs import MATTE, ProgramTest, command, main, render

RAYS = MATTE.parent / "rays.dae"
SMALL = ("--size", "64x48", "--spp", "4", "--threads", "1", "-q")
FRAMES = ("--frames", "1-24")
KILLS = 12


class Resume(ProgramTest):
    def undisturbed(self, *words):
        folder = self.folder / "whole"
        self.expect(render(MATTE, "-o", folder / "f.####.png", *words), 0)
        return self.pictures(folder)

    def test_kill_9_at_any_moment_leaves_whole_frames_and_the_rest_is_resumed(self):
        started = time.monotonic()
        wanted = self.undisturbed(*SMALL, *FRAMES)
        length = time.monotonic() - started
        self.assertEqual(len(wanted), 24)
        folder = self.folder / "killed"
        words = (MATTE, "-o", folder / "f.####.png", *SMALL, *FRAMES, "--skip-existing")
        seed = int.from_bytes(os.urandom(4), "little")
        chance = random.Random(seed)
        kills = 0
        for _ in range(KILLS):
            process = subprocess.Popen(command("kinora-render", *words))
            time.sleep(chance.uniform(0, 0.4 * length))
            kills += process.poll() is None
            process.kill()
            process.wait()
            for file in folder.glob("f.*.png") if folder.exists() else []:
                self.assertEqual(file.read_bytes(), wanted[file.name], f"seed {seed}")
        self.expect(render(*words), 0)
        got = {f.name: f.read_bytes() for f in folder.glob("f.*.png")}
        self.assertEqual(got, wanted, f"seed {seed}, {kills} kills")

    def test_skip_existing_keeps_what_is_whole_and_the_same(self):
        words = ("-o", self.folder / "f.##.exr", "--frames", "1-3")
        small = ("--size", "24x16", "--threads", "1")
        self.expect(render(MATTE, *words, *small, "--spp", "1"), 0)
        first = self.stamps()
        again = render(MATTE, *words, *small, "--spp", "1", "--skip-existing")
        self.expect(again, 0, "kept")
        self.assertEqual(self.stamps(), first)
        cut = self.folder / "f.02.exr"
        whole = cut.read_bytes()
        cut.write_bytes(whole[:-1])
        self.expect(render(MATTE, *words, *small, "--spp", "1", "--skip-existing"), 0)
        self.assertEqual(cut.read_bytes(), whole)
        self.expect(render(MATTE, *words, *small, "--spp", "2", "--skip-existing"), 0)
        self.assertFalse(set(self.stamps().values()) & set(first.values()))

    def test_skip_existing_sees_a_changed_shader_and_a_changed_scene(self):
        shader = self.write("s.sl", "surface s() { Ci = 0.25; Oi = 1; }")
        scene = self.write("scene.dae", MATTE.read_text())
        words = (scene, "--shader", f"*={shader}", "-o", self.folder / "a.png", "--size", "24x16",
                 "--spp", "1", "--skip-existing")
        self.expect(render(*words), 0)
        first = self.stamps()
        self.expect(render(*words), 0, "kept")
        shader.write_text("surface s() { Ci = 0.75; Oi = 1; }")
        self.expect(render(*words), 0)
        second = self.stamps()
        self.assertNotEqual(first, second)
        scene.write_text(MATTE.read_text().replace("</COLLADA>", "<!-- x --></COLLADA>"))
        self.expect(render(*words), 0)
        self.assertNotEqual(self.stamps(), second)

    def test_signals_drop_the_frame_and_leave_no_temporary_file(self):
        for number, code in ((signal.SIGINT, 130), (signal.SIGTERM, 143)):
            folder = self.folder / str(code)
            process = subprocess.Popen(
                command("kinora-render", MATTE, "-o", folder / "f.####.png", "--frames", "1-100000",
                        "--size", "96x64", "--spp", "16", "-q"))
            deadline = time.monotonic() + 30
            while not (folder.exists() and list(folder.glob("f.*.png"))):
                self.assertLess(time.monotonic(), deadline)
                time.sleep(0.01)
            process.send_signal(number)
            self.assertEqual(process.wait(timeout=30), code)
            self.assertGreater(len(self.pictures(folder)), 0)

    def test_a_tile_that_takes_minutes_does_not_hold_up_a_signal(self):
        self.check_stopped(RAYS, "--size", "32x32", "--spp", "100000")

    def test_nor_does_a_shader_that_loops_for_ever(self):
        endless = self.write("endless.sl", "surface endless() { float k = 0; while (1) k += u; Ci = k; Oi = 1; }")
        self.check_stopped(MATTE, "--size", "640x360", "--spp", "64", "--shader", f"*={endless}", running=2)

    def check_stopped(self, scene, *words, running=0):
        """It ends soon after a signal that comes after so many seconds, and leaves no file."""
        out = self.folder / "slow.png"
        process = subprocess.Popen(command("kinora-render", scene, "-o", out, *words, "-q"))
        deadline = time.monotonic() + 60
        while not self.catches(process.pid, signal.SIGTERM):
            self.assertLess(time.monotonic(), deadline)
            time.sleep(0.01)
        time.sleep(running)
        process.send_signal(signal.SIGTERM)
        self.assertEqual(process.wait(timeout=60), 143)
        self.assertEqual(list(self.folder.glob("*slow*")), [])

    @staticmethod
    def catches(pid, number):
        status = Path(f"/proc/{pid}/status").read_text()
        mask = next(line for line in status.splitlines() if line.startswith("SigCgt:")).split()[1]
        return int(mask, 16) >> (number - 1) & 1

    def test_two_processes_in_one_folder_both_finish(self):
        wanted = self.undisturbed(*SMALL, "--frames", "1-12")
        folder = self.folder / "both"
        words = command("kinora-render", MATTE, "-o", folder / "f.####.png", *SMALL, "--frames",
                        "1-12")
        processes = [subprocess.Popen(words), subprocess.Popen(words)]
        self.assertEqual([p.wait(timeout=60) for p in processes], [0, 0])
        self.assertEqual(self.pictures(folder), wanted)

    def stamps(self):
        """Which file stands behind each name, and since when."""
        return {f.name: (f.stat().st_ino, f.stat().st_mtime_ns)
                for f in self.folder.iterdir() if f.suffix in (".png", ".exr")}


if __name__ == "__main__":
    main()
