"""tests/programs/convert/folder_test.py: kinora-convert -r: a tree of scenes, its report, a run that is killed."""
import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
import programs
from convert_gltf_test import Gltf
from convert_test import Convert, convert, mesh_scene
from programs import command

BROKEN = "<COLLADA><scene>"


class Folders(Convert):
    def setUp(self):
        super().setUp()
        self.source, self.out = self.folder / "in", self.folder / "out"

    def convert_all(self, *words, code=0, to="glb"):
        return self.expect(convert("-r", self.source, self.out, "--to", to, *words), code)

    def report(self, *words, code=0, **options):
        self.convert_all("--report", self.folder / "r.json", *words, code=code, **options)
        return json.loads((self.folder / "r.json").read_text())

    def outputs(self):
        return sorted(str(f.relative_to(self.out)) for f in self.out.rglob("*")
                      if f.is_file() and not f.name.startswith(".kinora"))


class Tree(Folders):
    def test_the_tree_stays_and_names_that_meet_keep_their_extension(self):
        for name in ("a.dae", "b/c.dae", "b/d e/ä.DAE", "same.dae"):
            self.write(f"in/{name}", mesh_scene())
        self.write("in/same.gltf", Gltf().text())
        self.write("in/notes.txt", "no scene")
        self.convert_all("-j", "2")
        self.assertEqual(self.outputs(), ["a.glb", "b/c.glb", "b/d e/ä.glb", "same.dae.glb", "same.gltf.glb"])
        self.convert_all(to="dae")
        self.assertIn("same.gltf.dae", self.outputs())
        alone = self.converted(self.source / "a.dae", "alone.glb")
        self.assertEqual(alone.read_bytes(), (self.out / "a.glb").read_bytes())

    def test_an_output_inside_of_the_input_is_no_input(self):
        self.write("in/a.gltf", Gltf().text())
        self.out = self.source / "converted"
        for _ in range(2):
            self.convert_all()
            self.assertEqual(self.outputs(), ["a.glb"])

    def test_a_failure_costs_its_file_alone(self):
        for name in ("a.dae", "b.dae", "d.dae"):
            self.write(f"in/{name}", mesh_scene())
        self.write("in/c.dae", BROKEN)
        self.write("in/e.gltf", "{}")
        report = self.report(code=1)
        self.assertEqual(self.outputs(), ["a.glb", "b.glb", "d.glb"])
        outcomes = {f["input"]: f["outcome"] for f in report["files"]}
        self.assertEqual(outcomes, {"a.dae": "converted", "b.dae": "converted", "c.dae": "failed",
                                    "d.dae": "converted", "e.gltf": "failed"})
        self.assertEqual(report["summary"]["failed"], 2)
        broken = next(f for f in report["files"] if f["input"] == "c.dae")
        self.assertEqual(broken["exit"], 3)
        self.assertTrue(any(f["severity"] == "error" for f in broken["findings"]))
        self.write("in/c.dae", mesh_scene())  # mended: the next run tries what failed once more
        self.assertEqual(self.report(code=1)["summary"]["converted"], 4)

    def test_the_report_names_the_losses_of_each_file(self):
        gltf = Gltf(pbrMetallicRoughness={"metallicFactor": 1})
        self.write("in/metal.gltf", gltf.text())
        self.write("in/plain.dae", mesh_scene())
        report = self.report(to="dae")
        lost = {f["input"]: [x["message"] for x in f["lost"]] for f in report["files"]}
        self.assertEqual(lost["plain.dae"], [])
        self.assertTrue(any("metal" in text for text in lost["metal.gltf"]), lost)
        self.assertEqual(report["summary"]["with_losses"], 1)
        self.convert_all("--report", self.folder / "r.txt", to="dae")
        text = (self.folder / "r.txt").read_text()
        self.assertIn("metal.gltf -> metal.dae", text)
        self.assertIn("[CONVERT_LOST]", text)
        self.assertIn("2 files: 2 converted, 1 of them with losses; 0 failed", text)

    def test_usage(self):
        self.write("in/a.dae", mesh_scene())
        self.expect(convert("-r", self.source, self.out), 2, "--to")
        self.expect(convert("-r", self.source, self.source, "--to", "glb"), 2, "another folder")
        self.expect(convert("-r", self.source / "a.dae", self.out, "--to", "glb"), 2, "no folder")
        self.expect(convert(self.source / "a.dae", self.folder / "a.glb", "--report", "x"), 2, "-r")
        (self.folder / "empty").mkdir()
        self.expect(convert("-r", self.folder / "empty", self.out, "--to", "glb"), 3, "no scene files")


class Resume(Folders):
    COUNT = 200

    def setUp(self):
        super().setUp()
        for k in range(self.COUNT):
            text = BROKEN if k % 50 == 7 else mesh_scene().replace("0.8 0.1 0.1", f"0.{k:03} 0.5 0.1")
            self.write(f"in/{k % 10}/{k}.dae", text)

    def started(self, *words):
        return subprocess.Popen(command("kinora-convert", "-r", self.source, self.out, "--to", "glb", *words),
                                stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True)

    def end_after(self, count, number, whole_group):
        process = self.started("-j", "2")
        deadline = time.monotonic() + 60
        while process.poll() is None and len(list(self.out.rglob("*.glb"))) < count:
            self.assertLess(time.monotonic(), deadline)
            time.sleep(0.005)
        if process.poll() is None:
            (os.killpg if whole_group else os.kill)(process.pid, number)
        code = process.wait(timeout=60)
        while whole_group and self.lives(process.pid):  # its processes hold the folder's lock until they end
            self.assertLess(time.monotonic(), deadline)
            time.sleep(0.005)
        return code

    @staticmethod
    def lives(group):
        try:
            os.killpg(group, 0)
        except ProcessLookupError:
            return False
        return True

    def test_a_run_that_was_killed_goes_on_where_it_was(self):
        self.end_after(30, signal.SIGKILL, True)
        self.end_after(80, signal.SIGKILL, True)
        code = self.end_after(120, signal.SIGTERM, False)
        self.assertIn(code, (143, 1))
        before = {f: f.stat().st_mtime_ns for f in self.out.rglob("*.glb")}
        self.assertGreaterEqual(len(before), 120)
        report = self.report("-j", "2", code=1)
        self.assertEqual(report["summary"]["files"], self.COUNT)
        self.assertEqual(report["summary"]["converted"], self.COUNT - 4)
        self.assertEqual(report["summary"]["failed"], 4)
        again = [f for f, at in before.items() if f.stat().st_mtime_ns != at]
        self.assertLessEqual(len(again), 6)  # two a kill may have had their name and no line yet
        self.assertEqual([f for f in self.out.rglob(".*") if f.name != ".kinora-convert.jsonl"], [])
        other = self.folder / "other"
        self.expect(convert("-r", self.source, other, "--to", "glb", "-q"), 1)
        for file in other.rglob("*.glb"):
            self.assertEqual(file.read_bytes(), (self.out / file.relative_to(other)).read_bytes())

    def test_what_a_killed_run_left_half_written_goes_and_nothing_else(self):
        left = [".3.glb.host.1.tmp", ".13.glb.2.tmp"]
        others = [".3.glb", ".33.txt.1.tmp", "3.glb.tmp", ".unknown.glb.1.tmp"]
        for name in left + others:
            self.write(f"out/3/{name}", "half")
        self.convert_all("-j", "2", code=1)
        names = {f.name for f in (self.out / "3").iterdir()}
        self.assertEqual(names & set(left), set())
        self.assertLessEqual(set(others), names)

    def test_what_changed_is_converted_again(self):
        self.convert_all(code=1)
        at = {f: f.stat().st_mtime_ns for f in self.out.rglob("*.glb")}
        self.write("in/3/3.dae", mesh_scene().replace("0.8 0.1 0.1", "0.1 0.9 0.1"))
        (self.out / "4/4.glb").unlink()
        (self.out / "5/5.glb").write_bytes(b"cut")
        self.expect(convert("-r", self.source, self.out, "--to", "glb"), 1, "193 kept from before")
        changed = {str(f.relative_to(self.out)) for f in self.out.rglob("*.glb") if f.stat().st_mtime_ns != at.get(f)}
        self.assertEqual(changed, {"3/3.glb", "4/4.glb", "5/5.glb"})
        self.convert_all("--animation-error", "1e-3", code=1)  # another setting: all of them
        self.assertNotEqual((self.out / "6/6.glb").stat().st_mtime_ns, at[self.out / "6/6.glb"])

    def test_two_runs_do_not_write_into_one_folder(self):
        first = self.started("-j", "1")
        while first.poll() is None and not (self.out / ".kinora-convert.jsonl").exists():
            time.sleep(0.005)
        second = convert("-r", self.source, self.out, "--to", "glb")
        if first.poll() is None or second.code != 1:
            self.expect(second, 75, "another kinora-convert")
        first.wait(timeout=60)


if __name__ == "__main__":
    programs.main()
