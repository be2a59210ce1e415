"""tests/programs/render/render_resume_test.py: a render that is stopped loses nothing but time."""
import json
import os
import random
import shutil
import resource
import signal
import struct
import subprocess
import time
from pathlib import Path
import sys

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from programs import MATTE, SCENES, SOURCE, ProgramTest, command, main, render

sys.path.insert(0, str(SOURCE / "scripts/sheet"))
import png  # noqa: E402

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

    def stamped(self, name, change):
        """Changes a file as `change` does its bytes, and leaves its size and time of change."""
        file = self.folder / name
        status, before = file.stat(), file.read_bytes()
        after = change(before)
        self.assertEqual((len(after), after != before), (len(before), True))
        file.write_bytes(after)
        os.utime(file, ns=(status.st_atime_ns, status.st_mtime_ns))

    def renders_again(self, scene, *words):
        """Renders with --skip-existing: whether the picture was made anew."""
        before = self.stamps()
        self.expect(render(scene, "-o", self.folder / "a.exr", "--size", "24x16", "--spp", "1", "--skip-existing",
                           "--frames", "0", *words), 0)
        return self.stamps() != before

    def test_skip_existing_sees_the_content_of_textures_whatever_their_size_and_time(self):
        for row, colour in (("wall.png", 255), ("other.png", 100)):
            png.write(self.folder / row, 4, 4, [bytes([colour, 0, 0]) * 4] * 4)
        shader = self.write("s.sl", 'surface s(string map = "";) { Ci = texture(map); Oi = 1; }')
        words = ("--shader", f"*={shader}", "--param", f"*.map={self.folder / 'wall.png'}")
        scene = self.write("scene.dae", MATTE.read_text())
        self.assertTrue(self.renders_again(scene, *words))
        self.assertFalse(self.renders_again(scene, *words))
        other = (self.folder / "other.png").read_bytes()
        self.stamped("wall.png", lambda before: other)
        self.assertTrue(self.renders_again(scene, *words))
        os.utime(self.folder / "wall.png", (1, 1))  # a copy that is the same
        self.assertFalse(self.renders_again(scene, *words))

    def test_skip_existing_sees_the_content_of_linked_documents_and_buffers(self):
        glb = SCENES.parent / "gltf/bender.glb"
        shutil.copy(glb, self.folder / "a.glb")
        self.assertTrue(self.renders_again(self.folder / "a.glb"))
        self.assertFalse(self.renders_again(self.folder / "a.glb"))
        self.stamped("a.glb", lambda bytes: bytes[:-2] + b"\1\2")
        self.assertTrue(self.renders_again(self.folder / "a.glb"))
        triangle = struct.pack("<9f", -1, -1, 0, 1, -1, 0, 0, 1, 0)
        (self.folder / "a.bin").write_bytes(triangle)
        gltf = self.write("a.gltf", json.dumps({
            "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
            "buffers": [{"uri": "a.bin", "byteLength": 36}], "bufferViews": [{"buffer": 0, "byteLength": 36}],
            "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [-1, -1, 0],
                           "max": [1, 1, 0]}]}))
        self.assertTrue(self.renders_again(gltf))
        self.assertFalse(self.renders_again(gltf))
        self.stamped("a.bin", lambda bytes: struct.pack("<9f", -1, -1, 0, 1, -1, 0, 0.5, 1, 0))
        self.assertTrue(self.renders_again(gltf))

    def test_a_picture_made_without_an_asset_is_never_kept(self):
        shader = self.write("s.sl", 'surface s() { Ci = texture("nothere.png"); Oi = 1; }')
        scene = self.write("scene.dae", MATTE.read_text())
        words = ("--shader", f"*={shader}")
        for _ in range(3):
            self.assertTrue(self.renders_again(scene, *words))
        png.write(self.folder / "nothere.png", 4, 4, [bytes([255, 0, 0]) * 4] * 4)
        self.assertTrue(self.renders_again(scene, *words))
        self.assertFalse(self.renders_again(scene, *words))

    def test_a_picture_whose_bytes_have_changed_is_not_kept(self):
        for kind in ("png", "exr"):
            words = (MATTE, "-o", self.folder / f"f.##.{kind}", "--frames", "1-2", "--size", "64x48", "--spp", "1", "-q")
            self.expect(render(*words), 0)
            wanted = self.pictures()
            self.expect(render(*words, "--skip-existing"), 0)
            damaged = bytearray(wanted[f"f.02.{kind}"])
            for at in range(len(damaged) // 2, len(damaged) // 2 + 9):
                damaged[at] ^= 0xff
            (self.folder / f"f.02.{kind}").write_bytes(damaged)
            result = render(*words, "--skip-existing", "--stats=json")
            self.assertEqual([f["state"] for f in json.loads(result.out)["frames"]], ["kept", "done"])
            self.assertEqual(self.pictures(), wanted)

    def test_signals_drop_the_frame_and_leave_no_temporary_file(self):
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGXCPU, signal.SIGXFSZ):
            code = 128 + number
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

    def test_an_ignored_hangup_stays_ignored(self):
        """As nohup wants it."""
        process = subprocess.Popen(command("kinora-render", MATTE, "-o", self.folder / "f.png", *SMALL),
                                   preexec_fn=lambda: signal.signal(signal.SIGHUP, signal.SIG_IGN))
        while process.poll() is None:
            process.send_signal(signal.SIGHUP)
            time.sleep(0.01)
        self.assertEqual(process.returncode, 0)
        self.assertEqual(list(self.pictures()), ["f.png"])

    def test_a_limit_of_file_sizes_ends_the_run_after_whole_frames(self):
        limit = 1000
        process = subprocess.run(command("kinora-render", MATTE, "-o", self.folder / "f.####.exr", "--frames", "1-3",
                                         "--size", "96x64", "--spp", "1", "-q"),
                                 preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit)))
        self.assertEqual(process.returncode, 128 + signal.SIGXFSZ)
        self.assertEqual(self.pictures(), {})

    def test_a_limit_of_cpu_time_ends_the_run_after_whole_frames(self):
        process = subprocess.run(command("kinora-render", MATTE, "-o", self.folder / "f.####.png", "--frames",
                                         "1-100000", "--size", "96x64", "--spp", "4", "-q"),
                                 preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (1, 60)))
        self.assertEqual(process.returncode, 128 + signal.SIGXCPU)
        self.assertGreater(len(self.pictures()), 0)

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
