"""tests/programs/programs.py: runs the programs as their users do, for the black-box tests."""
import os
import re
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

SOURCE = Path(os.environ.get("KINORA_SOURCE_DIR", Path(__file__).parents[2])).resolve()
BIN = Path(os.environ.get("KINORA_BIN_DIR", SOURCE / "build/release/bin")).resolve()
SHARED = Path(os.environ.get("KINORA_SHARED", SOURCE.parent / "shared"))  # tests skip what is missing
TEST_DATA = Path(os.environ.get("KINORA_TEST_DATA", BIN.parent / "test_data")).resolve()
SCENES = SOURCE / "assets/scenes"
SHADERS = SOURCE / "assets/shaders"
MATTE = SCENES / "matte.dae"
TIMEOUT = 600  # seconds: more is a hang; other work may hold the processors


class Result:
    def __init__(self, code, out, err):
        self.code, self.out, self.err = code, out, err

    def __repr__(self):
        return f"exit {self.code}\n{self.out}\n{self.err}"


def command(program, *words):
    return [str(BIN / program), *map(str, words)]


def run(program, *words, stdin="", **options):
    done = subprocess.run(command(program, *words), input=stdin, capture_output=True, text=True,
                          errors="replace", timeout=TIMEOUT, **options)
    return Result(done.returncode, done.stdout, done.stderr)


def render(*words, **options):
    return run("kinora-render", *words, **options)


def shade(*words, **options):
    return run("kinora-shade", *words, **options)


def blender_writes_gltf():
    """Whether Debian's Blender is there, with the numpy that its glTF exporter needs."""
    if not shutil.which("blender"):
        return False
    return subprocess.run(["/usr/bin/python3", "-c", "import numpy"], capture_output=True).returncode == 0


def supported_targets():
    """Those that this CPU runs: the others are reported as not usable."""
    text = shade("bench", SHADERS / "constant.sl", "--size", "16x1", "--iterations", "1").out
    return [name for name in ("interp", "neon", "avx2", "avx512") if re.search(rf"^{name}:", text, re.M)]


class ProgramTest(unittest.TestCase):
    """A test with a folder of its own, gone afterwards."""

    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix="kinora_test_"))
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)

    def expect(self, result, code, *texts):
        """The exit code, and texts that must be in what was said."""
        self.assertEqual(result.code, code, result)
        for text in texts:
            self.assertIn(text, result.out + result.err)
        return result

    def whole_if(self, found):
        """Last line of a test that did without ../shared what it could: the rest counts as skipped."""
        if not found:
            self.skipTest("no ../shared: only this repository's files were tried")

    def write(self, name, text):
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
        return path

    def pictures(self, folder=None):
        """File name -> bytes of all pictures; temporary files make it fail."""
        files = sorted((folder or self.folder).iterdir())
        self.assertEqual([f.name for f in files if f.suffix == ".tmp"], [])
        return {f.name: f.read_bytes() for f in files if f.suffix in (".png", ".exr")}


def main():
    """Runs the tests of the program; exit code 77 tells CTest that all of them were skipped."""
    result = unittest.main(verbosity=1, exit=False).result
    all_skipped = 0 < result.testsRun <= len(result.skipped)
    raise SystemExit(77 if all_skipped else not result.wasSuccessful())
