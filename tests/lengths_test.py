#!/usr/bin/env python3
"""tests/lengths_test.py: no function of the rooms below has 50 lines or more.

A function's lines are those from its name to its closing brace. universal-ctags tells where each ends.
"""
import json
import subprocess
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from gauge import report  # noqa: E402

ROOT = Path(sys.argv[1] if len(sys.argv) > 1 else Path(__file__).parent.parent).resolve()
FOLDERS = ("runtime/picture/shading",)
FORBIDDEN = 50  # lines, and more
CTAGS = ("ctags", "--output-format=json", "--language-force=C++", "--kinds-C++=f", "--fields=+ne",
         "-L", "-", "-f", "-")


def functions_in(root):
    """Of each function defined there: path, line, name, lines."""
    paths = [path for folder in FOLDERS for path in sorted((root / folder).rglob("*"))
             if path.suffix in (".h", ".cpp")]
    try:
        run = subprocess.run(CTAGS, input="\n".join(map(str, paths)), capture_output=True, text=True, check=True)
    except FileNotFoundError:
        sys.exit("ctags is missing: scripts/install installs universal-ctags")
    tags = [json.loads(line) for line in run.stdout.splitlines()]
    return [(Path(tag["path"]).relative_to(root).as_posix(), tag["line"], tag["name"], tag["end"] - tag["line"] + 1)
            for tag in tags if "end" in tag]


def too_long(functions):
    return [f"{path}:{line}: {name} has {lines} lines" for path, line, name, lines in sorted(functions)
            if lines >= FORBIDDEN]


def function(name, lines):
    return f"void {name}() {{\n" + "    step();\n" * (lines - 2) + "}\n"


PLANTED = {
    "runtime/picture/shading/a.cpp": function("fits", FORBIDDEN - 1) + function("Queue::see", FORBIDDEN),
    "runtime/picture/shading/rays/b.h": "namespace {\n" + function("hidden", FORBIDDEN + 1) + "}\n",
    "runtime/picture/frame/c.cpp": function("elsewhere", FORBIDDEN),
}


def self_check():
    """The checker finds what is put before it, and nothing else."""
    with tempfile.TemporaryDirectory() as folder:
        root = Path(folder).resolve()
        for name, text in PLANTED.items():
            path = root / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text)
        found = too_long(functions_in(root))
    expected = [f"runtime/picture/shading/a.cpp:{FORBIDDEN}: see has {FORBIDDEN} lines",
                f"runtime/picture/shading/rays/b.h:2: hidden has {FORBIDDEN + 1} lines"]
    return [] if found == expected else [f"found {found} instead of {expected}"]


def main():
    functions = functions_in(ROOT)
    cases = [(f"{len(functions)} functions have less than {FORBIDDEN} lines", too_long(functions)),
             ("functions are found", [] if len(functions) > 300 else ["too few: has the form of ctags changed?"]),
             ("the checker finds planted faults", self_check())]
    return report(cases)


if __name__ == "__main__":
    sys.exit(main())
