"""tests/programs/commands_test.py: every command of README and docs runs as it stands there.

Blocks of ```sh run line by line in a folder that looks like the repository. kinora-render is wrapped so
that pictures are small (--scale, --spp); nothing else is changed. What cannot run here stands in LEFT.
"""
import os
import re
import subprocess
import sys
from pathlib import Path

from programs import BIN, SOURCE, ProgramTest, main

LEFT = {  # a command's first words: why it does not run here
    "scripts/dev": "builds the tree",
    "scripts/nightly": "takes hours",
    "ctest": "is what runs this",
    "build/release/tests/": "a test of its own",
    "KINORA_GDB=1": "needs gdb",
    "scripts/contact_sheet": "draws all shaders; a test of its own",
    "git": "changes the repository",
    "build/release/bin/kinora-shade manual clamp01": "the example is not in the language",
}
PAGES = sorted([SOURCE / "README.md", SOURCE / "CONTRIBUTING.md", *(SOURCE / "docs").glob("*.md")])
SMALL = '''#!/usr/bin/env python3
import os, sys
words = sys.argv[1:]
if "--list" not in words:
    for option, value in (("--scale", "5%"), ("--spp", "1")):
        fixed = option == "--spp" and any(word.startswith("--target-") for word in words)  # they choose it
        if option not in words and not fixed:
            words += [option, value]
os.execv(PROGRAM, [PROGRAM, *words])
'''


def blocks(text):
    """(language, text before, body) of each fenced block."""
    for found in re.finditer(r"^( *)```(\w+)\n(.*?)^\1```", text, re.M | re.S):
        indent, language, body = found.groups()
        yield language, text[:found.start()], re.sub(rf"(?m)^{indent}", "", body)


def commands(body):
    """Lines of a block, with those they continue on."""
    for line in body.replace("\\\n", " ").splitlines():
        if line.strip() and not line.lstrip().startswith("#"):
            yield line


class Commands(ProgramTest):
    def setUp(self):
        super().setUp()
        for name in ("assets", "runtime", "tests", "scripts", "docs"):
            (self.folder / name).symlink_to(SOURCE / name)
        (self.folder / "build").mkdir()
        (self.folder / "build/release").symlink_to(BIN.parent)
        shim = self.folder / "small/kinora-render"
        shim.parent.mkdir()
        shim.write_text(SMALL.replace("PROGRAM", repr(str(BIN / "kinora-render"))))
        shim.chmod(0o755)
        self.path = f"{shim.parent}:{BIN}:{os.environ['PATH']}"

    def run_page(self, page):
        ran = 0
        for language, before, body in blocks(page.read_text()):
            saved = re.search(r"Save this as `([\w./-]+)`[^`]*$", before)
            if saved:
                (self.folder / saved[1]).write_text(body)
            if language != "sh":
                continue
            for line in commands(body):
                if any(line.startswith(left) for left in LEFT):
                    continue
                if line.startswith("PATH="):
                    continue
                done = subprocess.run(["bash", "-c", line], cwd=self.folder, capture_output=True, text=True,
                                      timeout=300, env={**os.environ, "PATH": self.path})
                self.assertEqual(done.returncode, 0, f"{page.name}: {line}\n{done.stdout[-400:]}{done.stderr[-1500:]}")
                self.assertNotIn("error:", done.stderr, f"{page.name}: {line}")
                ran += 1
        return ran

    def test_run_as_they_stand(self):
        ran = {}
        for page in PAGES:
            with self.subTest(page=page.name):
                ran[page.name] = self.run_page(page)
        for page, least in (("README.md", 4), ("render.md", 8), ("shade.md", 5), ("convert.md", 4), ("validate.md", 7)):
            self.assertGreaterEqual(ran.get(page, 0), least, page)

    def test_a_command_that_fails_is_told(self):
        page = self.folder / "page.md"
        page.write_text("```sh\nkinora-render nosuch.dae -o a.png\n```\n")
        with self.assertRaisesRegex(AssertionError, "page.md: kinora-render nosuch.dae"):
            self.run_page(page)

    def test_what_is_left_out_is_still_there(self):
        text = "\n".join(page.read_text() for page in PAGES)
        for left in LEFT:
            self.assertIn(left, text)


if __name__ == "__main__":
    main()
