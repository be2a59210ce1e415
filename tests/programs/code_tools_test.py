"""Generated code as other tools see it: beside source lines, in perf's map, in GDB."""

import os
import re
import shutil
import subprocess
import unittest

from programs import ProgramTest, command, main, shade, supported_targets, SHADERS

MATTE = SHADERS / "matte.sl"


class CodeTools(ProgramTest):
    def run_with(self, variable, *words):
        """Runs a command with the variable set; its process and output."""
        process = subprocess.Popen([str(c) for c in words], stdout=subprocess.PIPE, text=True,
                                   stderr=subprocess.STDOUT, env={**os.environ, variable: "1"})
        out, _ = process.communicate(timeout=300)
        return process, out

    def compiled_target(self):
        targets = [t for t in supported_targets() if t != "interp"]
        if not targets:
            self.skipTest("this CPU runs the interpreter only")
        return targets[0]

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
                               "-ex", f"break {name}", "-ex", "run", "-ex", "backtrace 1",
                               "--args", *command("kinora-shade", "run", "--target", target, "--size",
                                                  "4x4", MATTE))
        if re.search(r"ptrace|Couldn't|not permitted|personality", out) and "Breakpoint 1," not in out:
            self.skipTest("gdb may not run programs here")
        self.assertRegex(out, rf"#0\s.*{name}", out)
        self.assertIn("matte.sl", out)


if __name__ == "__main__":
    main()
