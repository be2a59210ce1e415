"""tests/programs/docs_test.py: the pages that scripts/docs draws from tables are current."""
import os
import re
import shutil
import subprocess
import sys

from programs import BIN, SOURCE, ProgramTest, Result, main, shade

SCRIPT = "scripts/docs"
PAGES = ("docs/builtins.md", "docs/language.md", "docs/render.md", "docs/trade.md", "docs/play.md", "docs/promises.md")


def docs(root, *words):
    done = subprocess.run([sys.executable, root / SCRIPT, *words], capture_output=True, text=True, timeout=60,
                          env={**os.environ, "KINORA_BIN_DIR": str(BIN), "KINORA_SOURCE_DIR": str(SOURCE)})
    return Result(done.returncode, done.stdout, done.stderr)


class Pages(ProgramTest):
    def test_are_what_the_tables_say(self):
        result = docs(SOURCE, "--check")
        self.assertEqual(result.code, 0, f"\n{result.out}{result.err}")

    def copy(self):
        """Script and pages as a tree of their own."""
        for path in (SCRIPT, *PAGES):
            (self.folder / path).parent.mkdir(exist_ok=True)
            shutil.copy(SOURCE / path, self.folder / path)
        docs(self.folder)

    def test_that_are_not_current_are_named_and_mended(self):
        for page in PAGES:
            self.copy()
            path = self.folder / page
            current = path.read_text()
            changed = re.sub(r"\| color \|", "| colour |", current.replace("Absolute value", "Value").replace("| draft |", "| rough |")
                             .replace("fill color", "filling").replace("| `orbit right up`", "| `orbit`"))
            if page == "docs/render.md":  # presets stand in it by hand
                changed = current.replace("| number of the node |", "| of the node |")
            self.assertNotEqual(changed, current)
            path.write_text(changed)
            self.expect(docs(self.folder, "--check"), 1, f"{page} is not what the tables say; run scripts/docs")
            self.assertEqual(path.read_text(), changed)
            self.expect(docs(self.folder), 0, f"{page}: written")
            self.assertEqual(path.read_text(), current)
            self.expect(docs(self.folder, "--check"), 0)

    def test_keep_what_is_written_by_hand(self):
        self.copy()
        path = self.folder / "docs/language.md"
        path.write_text(path.read_text() + "\nBy hand.\n")
        self.expect(docs(self.folder, "--check"), 0)

    def test_without_their_marks_are_an_error(self):
        self.copy()
        path = self.folder / "docs/language.md"
        path.write_text(path.read_text().replace("<!-- end of globals -->", ""))
        self.expect(docs(self.folder), 1, "docs/language.md: needs one", "end of globals")


class Manual(ProgramTest):
    def test_has_an_entry_for_every_built_in(self):
        page = self.expect(shade("manual", "--markdown"), 0).out
        rows = re.findall(r"^(\w+) {2,}(.*)", shade("manual").out, re.M)
        names = {name for name, _ in rows} - set(
            re.findall(r"^GLOBAL\((\w+),", (SOURCE / "rsl/model/globals.def").read_text(), re.M))
        self.assertEqual(names, set(re.findall(r"^### (\w+)$", page, re.M)))
        for name in names:
            self.assertRegex(page, rf"(?m)^(T|void|\w+) {name}\(")

    def test_has_every_optional_parameter(self):
        page = shade("manual", "--markdown").out
        rows = re.findall(r'^    \{"(\w+)", k', (SOURCE / "rsl/model/pairs.cpp").read_text(), re.M)
        self.assertGreater(len(rows), 50)
        for name in rows:
            self.assertIn(f"\n| `{name}` |", page)

    def test_has_every_global_with_who_reads_and_writes_it(self):
        page = self.expect(shade("manual", "--markdown", "globals"), 0, "| `P` | point | varying | rw | rw | r |").out
        names = re.findall(r"^GLOBAL\((\w+),", (SOURCE / "rsl/model/globals.def").read_text(), re.M)
        self.assertEqual(re.findall(r"^\| `(\w+)` \|", page, re.M), names)

    def test_pages_that_are_none_are_usage_errors(self):
        self.expect(shade("manual", "--markdown", "built"), 2, "'built' is none of builtins, globals")
        self.expect(shade("manual", "sin", "--markdown"), 2, "leave 'sin' out")


if __name__ == "__main__":
    main()
