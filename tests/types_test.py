#!/usr/bin/env python3
"""tests/types_test.py: no two types of one name stand in one namespace.

Two files that define such types compile, and a program that links both has whichever constructor or
destructor the linker took: the one-definition rule is broken and nobody is told. universal-ctags
lists the types. Those in anonymous namespaces and inside other types are free.
"""
import collections
import json
import subprocess
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from gauge import report  # noqa: E402

ROOT = Path(sys.argv[1] if len(sys.argv) > 1 else Path(__file__).parent.parent).resolve()
FOLDERS = ("jit", "rsl", "collada", "anim", "skin", "raytrace", "runtime", "tests")
KINDS = ("class", "struct", "union", "enum", "typedef")
CTAGS = ("ctags", "--output-format=json", "--language-force=C++", "--kinds-C++=csugtn", "--fields=+KnsZ",
         "-L", "-", "-f", "-")


def sources(root):
    return [path for folder in FOLDERS for path in sorted((root / folder).rglob("*"))
            if path.suffix in (".h", ".cpp")]


def tags_of(paths):
    try:
        run = subprocess.run(CTAGS, input="\n".join(map(str, paths)), capture_output=True, text=True, check=True)
    except FileNotFoundError:
        sys.exit("ctags is missing: scripts/install installs universal-ctags")
    return [json.loads(line) for line in run.stdout.splitlines()]


def is_shared(tag):
    """Whether the tag is a type that other files could name."""
    scope = tag.get("scope", "")
    return tag["kind"] in KINDS and tag.get("scopeKind", "namespace") == "namespace" and "__anon" not in scope


def types_in(root):
    """Qualified name -> {file: line}."""
    found = collections.defaultdict(dict)
    for tag in filter(is_shared, tags_of(sources(root))):
        name = f"{tag.get('scope', '')}::{tag['name']}"
        found[name].setdefault(Path(tag["path"]).relative_to(root).as_posix(), tag["line"])
    return found


def repeated(types):
    return [f"{name}: " + ", ".join(f"{path}:{line}" for path, line in sorted(places.items()))
            for name, places in sorted(types.items()) if len(places) > 1]


PLANTED = {
    "runtime/a.h": "namespace kinora {\nstruct Twice {};\nstruct Outer { struct In {}; };\n"
                   "namespace { struct Hidden {}; }\nstruct Later;\n}\nnamespace kinora::a { class Other {}; }\n",
    "runtime/b.cpp": "namespace kinora {\nenum class Twice { A };\nstruct Further { struct In {}; };\n"
                     "namespace { struct Hidden {}; }\nstruct Later {};\n}\nnamespace kinora::b { class Other {}; }\n",
    "rsl/c.h": "namespace kinora {\nusing Twice = int;\n}\n",
}


def self_check():
    """The checker finds what is put before it, and nothing else."""
    with tempfile.TemporaryDirectory() as folder:
        for name, text in PLANTED.items():
            path = Path(folder).resolve() / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text)
        found = repeated(types_in(Path(folder).resolve()))
    expected = ["kinora::Twice: rsl/c.h:2, runtime/a.h:2, runtime/b.cpp:2"]
    return [] if found == expected else [f"found {found} instead of {expected}"]


def main():
    types = types_in(ROOT)
    cases = [(f"{len(types)} types have names of their own", repeated(types)),
             ("types are found", [] if len(types) > 500 else ["too few: has the form of ctags changed?"]),
             ("the checker finds planted faults", self_check())]
    return report(cases)


if __name__ == "__main__":
    sys.exit(main())
