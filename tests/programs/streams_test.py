"""tests/programs/streams_test.py: stdout that nobody reads, in all programs."""
import os
import subprocess

from programs import MATTE, SHADERS, TIMEOUT, ProgramTest, command, main

SMALL = ("--size", "8x8", "--spp", "1", "--threads", "1")
NOISY = "surface noisy() { printf(\"%f %f %f\\n\", u, v, P); Ci = 1; Oi = 1; }"


class Streams(ProgramTest):
    def rows(self):
        """Command lines that print to stdout: little, and more than a pipe holds."""
        plastic, out = SHADERS / "plastic.sl", self.folder / "a.png"
        noisy = self.write("noisy.sl", NOISY)
        many = [MATTE] * 300
        for program in ("kinora-render", "kinora-play", "kinora-shade", "kinora-validate", "kinora-convert"):
            yield program, "--help"
            yield program, "--version"
        yield "kinora-render", MATTE, "--list"
        yield "kinora-render", MATTE, "--explain"
        yield "kinora-render", MATTE, "--dump", "ir,asm"
        yield "kinora-render", MATTE, "-o", out, *SMALL, "--stats=json", "-q"
        yield "kinora-render", MATTE, "-o", out, "--size", "160x120", "--spp", "1", "--shader", f"*={noisy}", "-q"
        yield "kinora-shade", "info", plastic
        yield "kinora-shade", "dump", plastic
        yield "kinora-shade", "manual"
        yield "kinora-validate", "--print-schema", "1.5"
        yield "kinora-validate", "--explain", "all"
        yield "kinora-validate", "-v", "--format", "json", *many
        yield "kinora-validate", "--fix", "--diff", *many
        yield "kinora-convert", MATTE, self.folder / "a.glb", "--stats"
        script = self.write("script.txt", "seek 1\n" * 9)
        yield "kinora-play", MATTE, "--headless", "--script", script, *SMALL

    def started(self, words, **options):
        """Like a shell's child: SIGPIPE ends it unless it sees to that."""
        return subprocess.Popen(command(*words), stderr=subprocess.PIPE, text=True, errors="replace",
                                restore_signals=True, **options)

    def ended(self, process, words):
        said = process.stderr.read()
        process.stderr.close()
        self.assertEqual(process.wait(timeout=TIMEOUT), 0, f"{words[:5]}: {said}")
        self.assertNotIn("stdout", said)

    def test_a_reader_that_has_gone_away_is_no_error(self):
        for words in self.rows():
            with self.subTest(words=words[:5]):
                read, write = os.pipe()
                os.close(read)
                process = self.started(words, stdout=write)
                os.close(write)
                self.ended(process, words)

    def test_a_reader_that_goes_away_is_no_error(self):
        for words in self.rows():
            with self.subTest(words=words[:5]):
                process = self.started(words, stdout=subprocess.PIPE)
                process.stdout.read(1)
                process.stdout.close()
                self.ended(process, words)

    def test_a_closed_stdout_is_no_error_and_no_picture_gets_what_is_printed(self):
        for words in self.rows():
            with self.subTest(words=words[:5]):
                self.ended(self.started(words, preexec_fn=lambda: os.close(1)), words)
        out = self.folder / "picture.png"
        words = ("kinora-render", MATTE, "-o", out, *SMALL, "--stats", "-q")
        self.ended(self.started(words, stdout=subprocess.DEVNULL), words)
        wanted = out.read_bytes()
        for closed in ((1,), (0, 1), (1, 2), (0, 1, 2)):
            out.unlink()
            done = subprocess.run(command(*words), preexec_fn=lambda: [os.close(stream) for stream in closed])
            self.assertEqual((done.returncode, out.read_bytes()), (0, wanted), closed)

    def test_a_full_disk_is_one(self):
        for words in (("kinora-render", MATTE, "--list"), ("kinora-validate", "--explain", "all"),
                      ("kinora-shade", "manual"), ("kinora-convert", "--help"), ("kinora-play", "--help")):
            with self.subTest(words=words), open("/dev/full", "w") as full:
                done = subprocess.run(command(*words), stdout=full, stderr=subprocess.PIPE, text=True)
                self.assertEqual(done.returncode, 6)
                self.assertIn("cannot write to stdout", done.stderr)


if __name__ == "__main__":
    main()
