"""tests/programs/render/tradeoff_test.py: kinora-render --tradeoff, from a scene to a page in a browser."""
import csv
import json
import re
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path
import sys

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from programs import MATTE, SCENES, ProgramTest, main, render

SMALL = ("--shader", "*=marble", "--size", "32x24", "--budget", "40s", "--threads", "2", "-q")


class Tradeoff(unittest.TestCase):
    """One run, looked at from all sides."""

    @classmethod
    def setUpClass(cls):
        cls.folder = Path(tempfile.mkdtemp(prefix="kinora_tradeoff_"))
        cls.result = render(MATTE, "--tradeoff", cls.folder / "out", *SMALL)
        assert cls.result.code == 0, cls.result
        cls.json = json.loads((cls.folder / "out/tradeoff.json").read_text())
        cls.page = (cls.folder / "out/tradeoff.html").read_text()
        cls.rows = [row for row in cls.json["rows"] if "errors" in row]

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder, ignore_errors=True)

    def row(self, name):
        return next(row for row in self.rows if row["name"].startswith(name))

    def test_presets_cost_more_and_err_less_in_their_order(self):
        errors = [self.row(name)["errors"]["flip"] for name in ("draft", "preview", "final")]
        self.assertEqual(errors, sorted(errors, reverse=True))
        self.assertGreater(errors[0], self.json["noise_floor"]["flip"])

    def test_errors_fall_with_samples(self):
        rmse = [self.row(f"final spp={n}")["errors"]["rmse"] for n in (1, 4, 16)]
        self.assertEqual(rmse, sorted(rmse, reverse=True))

    def test_each_row_says_what_it_is(self):
        knobs = json.loads(render("--knobs", "json").out)
        for row in self.json["rows"]:
            self.assertEqual(set(row["settings"]), {knob["name"] for knob in knobs if knob["program"] == "kinora-render"})
            self.assertEqual("errors" in row, "not_measured" not in row)
            if "knob" in row and row["settings"][row["knob"]] is not None:
                value = row["settings"][row["knob"]]
                self.assertEqual(value, row["setting"] if isinstance(value, str) else float(row["setting"]))
        for row in self.rows:
            times = row["times"]
            self.assertLessEqual(times["low"], times["cpu_ms"])
            self.assertLessEqual(times["cpu_ms"], times["high"])
            stages = sum(times["stages"].values())
            self.assertAlmostEqual(stages / times["cpu_ms"], 1, delta=0.01)

    def test_knobs_of_time_alone_keep_the_picture(self):
        for row in self.json["rows"]:
            if row.get("knob") in ("bvh", "refit-limit"):  # nothing moves: they do nothing at all
                self.assertTrue(row.get("same_as_base") or row["same_picture_as_base"], row["name"])
        for row in self.rows:
            if row.get("knob") == "filter":
                self.assertFalse(row["same_picture_as_base"], row["name"])

    def test_probes_see_what_they_are_for(self):
        fast, precise = self.row("final math=fast"), self.row("final")
        self.assertEqual(precise["errors"]["hit_distance"], 0)
        self.assertEqual(precise["errors"]["vertex_units"], 0)
        self.assertGreater(fast["errors"]["ulp_max"], 0)

    def test_the_table_is_that_of_the_json(self):
        with open(self.folder / "out/tradeoff.csv") as file:
            table = list(csv.DictReader(file))
        self.assertEqual([row["name"] for row in table], [row["name"] for row in self.json["rows"]])
        for line, row in zip(table, self.json["rows"]):
            if "errors" not in row:
                self.assertEqual(line["flip"], "")
            elif "flip" in row["within_floor"]:
                self.assertEqual(line["flip"], "<= floor")
            else:
                self.assertAlmostEqual(float(line["flip"]) / row["errors"]["flip"], 1, delta=0.001)

    def test_a_browser_sorts_its_tables(self):
        chromium = shutil.which("chromium")
        if not chromium:
            self.skipTest("chromium is not installed")
        # What a user does: a click on "CPU ms" of the knobs' table, then another.
        page = self.page.replace("</body>", """<script>
            const table = document.querySelectorAll('table')[1], head = table.tHead.rows[0].cells[1];
            const times = () => [...table.tBodies[0].rows].map(r => r.cells[1].dataset.v)
              .filter(v => v !== undefined).map(Number);
            const sorted = (list, sign) => list.every((v, i) => !i || sign * (v - list[i - 1]) >= 0);
            const before = sorted(times(), 1);
            head.click(); const up = sorted(times(), 1);
            head.click(); const down = sorted(times(), -1);
            const images = [...document.images];
            Promise.all(images.map(i => i.decode())).then(() => { document.title =
              [before, up, down, times().length, images.length,
               images.filter(i => i.naturalWidth > 0).length,
               document.querySelectorAll('svg circle').length].join(' '); });
            </script></body>""")
        file = self.folder / "page.html"
        file.write_text(page)
        with tempfile.TemporaryDirectory() as profile:
            dom = subprocess.run(
                [chromium, "--headless", "--no-sandbox", "--disable-gpu", "--virtual-time-budget=20000",
                 f"--user-data-dir={profile}", "--dump-dom", f"file://{file}"],
                capture_output=True, text=True, timeout=120).stdout
        title = re.search(r"<title>([^<]*)</title>", dom)
        self.assertTrue(title, dom[:2000])
        before, up, down, knobs, images, shown, points = title.group(1).split()
        self.assertEqual((before, up, down), ("false", "true", "true"))
        self.assertEqual(int(knobs), sum("knob" in row for row in self.rows))
        self.assertGreater(int(images), len(self.rows))
        self.assertEqual(images, shown)
        self.assertGreaterEqual(int(points), len(self.rows))

    def test_the_page_needs_no_network(self):
        self.assertNotRegex(self.page, r"https?://|@import|<link|url\(")


class Usage(ProgramTest):
    def test_assertions_decide_the_exit_code(self):
        words = (MATTE, "--tradeoff", self.folder, "--size", "16x12", "--budget", "20s", "-q")
        self.expect(render(*words, "--assert", "preset=final:flip<0.5", "--assert", "preset=draft:ssim>2"),
                    1, "error: --assert preset=draft:ssim>2: ssim is 0.")

    def test_mistakes_are_told(self):
        rows = [
            (("--tradeoff", self.folder, "-o", "a.png"), 2, "leave -o"),
            (("--tradeoff", self.folder, "--budget", "soon"), 2, "takes seconds"),
            (("--budget", "5s", "-o", "null"), 2, "--tradeoff"),
            (("--assert", "preset=final:flip<1", "-o", "null"), 2, "--tradeoff"),
            (("--tradeoff", self.folder, "--assert", "preset=final:floop<1"), 2, "'floop' is none of ms"),
            (("--tradeoff", "/proc/none/out"), 6, "cannot write '/proc/none/out'"),
        ]
        for words, code, text in rows:
            with self.subTest(words=words):
                self.expect(render(MATTE, *words), code, text)

    def test_a_budget_that_is_too_small_says_what_it_left_out(self):
        result = render(SCENES / "walker.dae", "--tradeoff", self.folder, "--budget", "1s")
        if result.code == 1:  # not even the presets
            self.expect(result, 1, "--budget: 1 s are too little", "references and the presets")
            return
        self.expect(result, 0, "variants measured")
        rows = json.loads((self.folder / "tradeoff.json").read_text())["rows"]
        self.assertTrue(any("budget" in row.get("not_measured", "") for row in rows))


if __name__ == "__main__":
    main()
