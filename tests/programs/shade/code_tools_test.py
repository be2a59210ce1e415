"""Generated code as other tools see it: beside source lines, in perf's map, in GDB."""

import ctypes
import os
import re
import shutil
import struct
import subprocess
import tempfile
import unittest
from pathlib import Path
import sys

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from programs import ProgramTest, command, main, run, shade, supported_targets, SCENES, SHADERS

MATTE = SHADERS / "matte.sl"


# Linux, tools/perf/Documentation/jitdump-specification.txt.
CODE_LOAD, DEBUG_INFO = 0, 2


def text_at(data, at):
    """The text that ends with a zero, and where what follows begins."""
    end = data.index(b"\0", at)
    return data[at:end].decode(), end + 1


def read_jitdump(data):
    magic, version, size, machine, _, pid, time, flags = struct.unpack_from("<6I2Q", data)
    assert (magic, version, size, flags) == (0x4A695444, 1, 40, 0), data[:40]
    assert machine in (62, 183), machine  # x86-64, AArch64
    records, at = [], size
    while at < len(data):
        kind, size, when = struct.unpack_from("<2IQ", data, at)
        body, at = data[at + 16:at + size], at + size
        record = {"id": kind, "time": when}
        if kind == CODE_LOAD:
            _, _, place, record["address"], bytes_, record["index"] = struct.unpack_from("<2I4Q", body)
            assert place == record["address"]
            record["name"], begin = text_at(body, 40)
            record["code"] = body[begin:]
            assert len(record["code"]) == bytes_
        elif kind == DEBUG_INFO:
            record["address"], count = struct.unpack_from("<2Q", body)
            record["rows"], begin = [], 16
            for _ in range(count):
                row = struct.unpack_from("<Q2I", body, begin)
                name, begin = text_at(body, begin + 16)
                record["rows"].append((*row, name))
            assert begin == len(body)
        else:
            assert False, f"record {kind}"
        records.append(record)
    return {"pid": pid, "time": time}, records


class CodeTools(ProgramTest):
    def run_with(self, variable, *words, value="1"):
        """Runs a command with the variable set; its process and output."""
        process = subprocess.Popen([str(c) for c in words], stdout=subprocess.PIPE, text=True,
                                   stderr=subprocess.STDOUT, env={**os.environ, variable: value})
        out, _ = process.communicate(timeout=300)
        return process, out

    def compiled_target(self):
        targets = [t for t in supported_targets() if t != "interp"]
        if not targets:
            self.skipTest("this CPU runs the interpreter only")
        return targets[0]

    def test_a_broken_capstone_is_told_and_other_stages_need_none(self):
        target = self.compiled_target()
        listing = subprocess.run(["ldconfig", "-p"], capture_output=True, text=True,
                                 env={**os.environ, "PATH": os.environ["PATH"] + ":/sbin"})
        names = re.findall(r"^\s*(libcapstone\.so\.\d+) ", listing.stdout, re.M)
        self.assertTrue(names, listing)
        with tempfile.TemporaryDirectory() as folder:
            for name in names:
                Path(folder, name).write_text("this is no library\n" * 100)
            broken = {**os.environ, "LD_LIBRARY_PATH": folder}
            result = shade("dump", "--stage", "asm", "--target", target, MATTE, env=broken)
            self.expect(result, 5)
            self.assertRegex(result.err, r"libcapstone\.so\.\d+, which cannot be loaded \(.+\)")
            self.expect(shade("dump", "--stage", "ir", "--target", target, MATTE, env=broken), 0,
                        "; stage ir")

    def test_assembly_stands_beside_source_lines(self):
        """Each line that is in the listing is a line of the file, as it stands there."""
        lines = MATTE.read_text().splitlines()
        for target in supported_targets():
            if target == "interp":
                continue
            result = shade("dump", "--stage", "asm", "--target", target, MATTE)
            self.expect(result, 0, "bytes of constants")
            shown = re.findall(r"^; \S*matte\.sl:(\d+): (.*)$", result.out, re.M)
            self.assertTrue(shown, result)
            for number, text in shown:
                self.assertEqual(lines[int(number) - 1].strip(), text.strip())
            code = re.findall(r"^  [0-9a-f]{4,}  (\S+)", result.out, re.M)
            self.assertGreater(len(code), 20, result)
            unknown = sum(mnemonic.startswith(".byte") for mnemonic in code)
            self.assertLess(unknown * 20, len(code), result)

    def test_perf_map_names_the_kernels(self):
        target = self.compiled_target()
        process, out = self.run_with("KINORA_PERF", *command(
            "kinora-shade", "run", "--target", target, "--size", "4x4", MATTE))
        path = f"/tmp/perf-{process.pid}.map"
        self.assertEqual(process.returncode, 0, out)
        with open(path) as file:
            rows = [line.split() for line in file]
        os.remove(path)
        self.assertIn(f"kinora_matte_{target}", [row[2] for row in rows])
        for start, size, _ in rows:
            self.assertGreater(int(start, 16), 0)
            self.assertGreater(int(size, 16), 0)

    def test_jitdump_holds_code_and_lines(self):
        target = self.compiled_target()
        with tempfile.TemporaryDirectory() as folder:
            process, out = self.run_with("KINORA_JITDUMP", *command(
                "kinora-shade", "run", "--target", target, "--size", "4x4", MATTE), value=folder)
            self.assertEqual(process.returncode, 0, out)
            head, records = read_jitdump(Path(folder, f"jit-{process.pid}.dump").read_bytes())
        self.assertEqual(head["pid"], process.pid)
        loads = [r for r in records if r["id"] == CODE_LOAD]
        self.assertEqual([r["index"] for r in loads], list(range(len(loads))))
        named = [r for r in loads if r["name"] == f"kinora_matte_{target}"]
        self.assertTrue(named, [r["name"] for r in loads])
        stamps = [head["time"]] + [r["time"] for r in records]
        self.assertEqual(stamps, sorted(stamps))
        matte = named[0]
        lines = [r for r in records if r["id"] == DEBUG_INFO and r["address"] == matte["address"]]
        self.assertEqual(len(lines), 1)
        self.assertLess(records.index(lines[0]), records.index(matte))
        text = MATTE.read_text().splitlines()
        self.assertTrue(lines[0]["rows"])
        for address, line, column, file in lines[0]["rows"]:
            self.assertIn(address, range(matte["address"], matte["address"] + len(matte["code"])))
            self.assertTrue(file.endswith("matte.sl"), file)
            self.assertGreater(len(text[line - 1]), column - 1)
        listing = shade("dump", "--stage", "asm", "--target", target, MATTE).out
        self.assertLessEqual({row[1] for row in lines[0]["rows"]},
                             {int(n) for n in re.findall(r"^; \S*matte\.sl:(\d+): ", listing, re.M)})

    def test_perf_names_kernels_from_the_jitdump(self):
        target = self.compiled_target()
        if shutil.which("perf") is None:
            self.skipTest("perf is not installed")
        with tempfile.TemporaryDirectory() as folder:
            data, injected = Path(folder, "perf.data"), Path(folder, "injected.data")
            process, out = self.run_with(
                "KINORA_JITDUMP", "perf", "record", "-k", "1", "-e", "cpu-clock", "-o", data, "--",
                *command("kinora-shade", "bench", "--target", target, MATTE), value=folder)
            if process.returncode != 0 or not data.exists():
                self.skipTest(f"perf may not record here: {out[-200:]}")
            subprocess.run(["perf", "inject", "--jit", "-i", data, "-o", injected], check=True,
                           capture_output=True, cwd=folder)
            report = subprocess.run(["perf", "report", "--stdio", "-i", injected, "--sort", "sym"],
                                    capture_output=True, text=True, check=True).stdout
        self.assertIn(f"kinora_matte_{target}", report)

    def test_no_map_is_written_unless_asked(self):
        process = subprocess.Popen(command("kinora-shade", "run", "--size", "4x4", MATTE),
                                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        process.communicate(timeout=300)
        self.assertFalse(os.path.exists(f"/tmp/perf-{process.pid}.map"))

    def test_gdb_stops_in_a_kernel_by_name(self):
        target = self.compiled_target()
        if shutil.which("gdb") is None:
            self.skipTest("gdb is not installed")
        name = f"kinora_matte_{target}"
        _, out = self.run_with("KINORA_GDB", "gdb", "-batch", "-nx", "-iex",
                               "set debuginfod enabled off", "-ex", "set breakpoint pending on",
                               "-ex", f"break {name}", "-ex", "run", "-ex", "backtrace",
                               "--args", *command("kinora-shade", "run", "--target", target, "--size",
                                                  "4x4", MATTE))
        if re.search(r"ptrace|Couldn't|not permitted|personality", out) and "Breakpoint 1," not in out:
            self.skipTest("gdb may not run programs here")
        self.assertRegex(out, rf"#0\s.*{name}", out)
        self.assertIn("matte.sl", out)
        self.expect_whole_backtrace(out, name)

    def expect_whole_backtrace(self, out, name):
        """From the kernel by way of what ran it to main."""
        self.assertNotIn("??", out)
        self.assertRegex(out, rf"(?s)#\d+\s[^\n]*{name}.*Kernel::run.*#\d+\s[^\n]*\bmain \(", out)

    def test_gdb_finds_its_way_out_of_the_middle_of_a_kernel(self):
        """At each instruction of the entry, at a line of the shader, and in a service."""
        target = self.compiled_target()
        if shutil.which("gdb") is None:
            self.skipTest("gdb is not installed")
        name = f"kinora_waves_{target}"
        shader = self.write("waves.sl", "surface waves() {\n  float x = sin(s * 9);\n"
                            "  Ci = texture(\"none.tex\", s + x, t);\n  Oi = 1;\n}\n")
        stops = []
        for text in ("break waves.sl:2", "run"):
            stops += ["-ex", text]
        for _ in range(12):
            stops += ["-ex", "backtrace", "-ex", "stepi"]
        for text in ("break waves.sl:3", "continue", "backtrace", "delete"):
            stops += ["-ex", text]
        stops += ["-ex", "rbreak ^.*texture.*ServiceCall", "-ex", "continue",
                  "-ex", "backtrace"]
        _, out = self.run_with("KINORA_GDB", "gdb", "-batch", "-nx", "-iex",
                               "set debuginfod enabled off", "-iex", "set confirm off",
                               "-iex", "set breakpoint pending on", *stops, "--args",
                               *command("kinora-shade", "run", "--target", target, "--size", "4x4",
                                        shader))
        if re.search(r"ptrace|Couldn't|not permitted|personality", out) and "Breakpoint 1," not in out:
            self.skipTest("gdb may not run programs here")
        self.expect_whole_backtrace(out, name)
        self.assertGreaterEqual(len(re.findall(r"#\d+\s[^\n]*\bmain \(", out)), 14, out)

    def test_a_jitdump_that_cannot_be_written_is_told(self):
        target = self.compiled_target()
        process, out = self.run_with("KINORA_JITDUMP", *command(
            "kinora-shade", "run", "--target", target, "--size", "4x4", MATTE),
            value=str(self.folder / "nowhere"))
        self.assertEqual(process.returncode, 0, out)
        self.assertEqual(out.count("KINORA_JITDUMP: cannot write"), 1, out)
        self.assertIn("No such file or directory", out)


PR_SET_MDWE, MDWE_REFUSE_EXEC_GAIN = 65, 1  # linux/prctl.h


def refuse_executable_memory():
    ctypes.CDLL(None, use_errno=True).prctl(PR_SET_MDWE, MDWE_REFUSE_EXEC_GAIN, 0, 0, 0)


class Interpreted(ProgramTest):
    """Where no code can run, shaders are interpreted, and whoever waits for them is told why."""

    def setUp(self):
        super().setUp()
        if supported_targets() == ["interp"]:
            self.skipTest("this CPU runs the interpreter only")

    def refused(self, program, *words):
        result = run(program, *words, preexec_fn=refuse_executable_memory)
        if "interpreted" not in result.err and "cannot" not in result.err:
            bench = run("kinora-shade", "bench", SHADERS / "constant.sl", "--size", "16x1",
                        "--iterations", "1", preexec_fn=refuse_executable_memory)
            if "avx" in bench.out or "neon" in bench.out:
                self.skipTest("this system does not know PR_SET_MDWE")
        return result

    def test_shade_says_that_no_memory_can_be_executable(self):
        result = self.refused("kinora-shade", "run", "--size", "4x4", MATTE)
        self.expect(result, 0, " on interp: ")
        self.assertEqual(result.err.count("TARGET_INTERPRETED"), 1, result)
        meant = self.refused("kinora-shade", "run", "--target", "interp", "--size", "4x4", MATTE)
        self.assertNotIn("TARGET_INTERPRETED", meant.err)

    def test_bench_has_no_rows_of_targets_that_cannot_run(self):
        result = self.refused("kinora-shade", "bench", "--size", "16x1", "--iterations", "1", MATTE)
        self.expect(result, 0, "interp: ms", "TARGET_INTERPRETED")
        self.assertNotRegex(result.out, r"(?m)^(avx2|avx512|neon):")

    def test_render_says_so_once(self):
        picture = self.folder / "a.png"
        words = (SCENES / "matte.dae", "--size", "16x16", "-o", picture)
        result = self.refused("kinora-render", *words)
        self.expect(result, 0)
        self.assertEqual((result.out + result.err).count("TARGET_INTERPRETED"), 1, result)
        result = self.refused("kinora-render", *words, "--target", "avx2")
        self.expect(result, 0, "target avx2 cannot be used here; running on interp")

    def test_an_older_cpu_is_told(self):
        emulator = shutil.which("qemu-x86_64-static") or shutil.which("qemu-x86_64")
        if emulator is None or os.uname().machine != "x86_64":
            self.skipTest("qemu's user mode is not installed")
        # Its shadow memory of 20 TiB is more than an emulated process may have; the release build is
        # asked the same.
        if b"__asan_init" in Path(command("kinora-shade")[0]).read_bytes():
            self.skipTest("qemu does not run AddressSanitizer")
        done = subprocess.run([emulator, "-cpu", "Nehalem", *command(
            "kinora-shade", "run", "--size", "4x4", MATTE)], capture_output=True, text=True, timeout=300)
        if done.returncode in (126, 127) or "Segmentation" in done.stderr:
            self.skipTest(f"qemu cannot run it: {done.stderr[-200:]}")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stderr.count("TARGET_INTERPRETED"), 1, done.stderr)
        self.assertIn(" on interp: ", done.stdout)


if __name__ == "__main__":
    main()
