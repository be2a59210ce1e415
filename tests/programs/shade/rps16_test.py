"""tests/programs/shade/rps16_test.py: what RenderMan Pro Server 16 had of its language: each row of
tests/rsl/rps16.txt compiles, or gives the one error that it names, and docs/language.md says so."""
import json
import re
from pathlib import Path
import sys

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from programs import SOURCE, ProgramTest, main, shade

ROW = re.compile(r"^== (.+?) => (\w+)\n((?:(?!== ).*\n)+)", re.M)

WARNINGS = ("RSL_NOT_COMPUTED", "RSL_LIGHT_METHOD", "RSL_PAIR_UNKNOWN", "RSL_PAIR_IDLE")


def rows():
    return ROW.findall((SOURCE / "tests/rsl/rps16.txt").read_text())


class Rps16(ProgramTest):
    def test_each_row_does_what_it_says(self):
        self.assertGreaterEqual(len(rows()), 70)
        self.assertEqual(len({title for title, _, _ in rows()}), len(rows()))
        for title, result, source in rows():
            path = Path(self.folder) / "row.sl"
            path.write_text(source)
            done = shade("check", path, "--json")
            findings = json.loads(done.out)[0]["findings"]
            errors = {f["code"] for f in findings if f["severity"] == "error"}
            if result in WARNINGS:
                self.assertEqual(errors, set(), f"{title}\n{done}")
                self.assertIn(result, {f["code"] for f in findings}, title)
            else:
                self.assertEqual(errors, set() if result == "compiles" else {result}, f"{title}\n{done}")

    def test_the_page_has_the_same_rows(self):
        text = (SOURCE / "docs/language.md").read_text()
        table = text[text.index("## What RPS 16 had"):].split("\n## ")[0].split("\n## ")[0]
        told = re.findall(r"^\| (.+?) \| `?(\w+)`? \|$", table, re.M)
        self.assertEqual(told[1:], [(title, result) for title, result, _ in rows()])


if __name__ == "__main__":
    main()
