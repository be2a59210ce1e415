#!/usr/bin/env python3
"""tests/knobs_test.py: some code obeys each knob of runtime/scene/quality/knobs.def.

Settings are held by value in objects named `quality`. A knob is read where a source of the product
has `quality.MEMBER`, not to assign to it. What presets, trade-offs and explanations read does not
count: they handle all knobs, or say what another place does.
"""
import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from gauge import report  # noqa: E402

ROOT = Path(sys.argv[1] if len(sys.argv) > 1 else Path(__file__).parent.parent).resolve()
FOLDERS = ("jit", "rsl", "anim", "skin", "raytrace", "runtime")
NOT_OBEYING = ("runtime/picture/trade/", "runtime/programs/tradeoff/", "runtime/picture/explain/")
ROW = re.compile(r"^KNOB\([\w:]+, (\w+),", re.M)
READ = re.compile(r"\bquality(?:_|\(\))?\s*(?:\.|->)\s*(\w+)\b(?!\s*=[^=])")


def without_comments(text):
    return re.sub(r"//[^\n]*", "", text)


def members_of(table):
    return ROW.findall(without_comments(table))


def read_in(text):
    return set(READ.findall(without_comments(text)))


def sources():
    for folder in FOLDERS:
        for path in sorted((ROOT / folder).rglob("*")):
            name = path.relative_to(ROOT).as_posix()
            if path.suffix in (".h", ".cpp") and not name.startswith(NOT_OBEYING):
                yield path.read_text(errors="replace")


def unread(members, texts):
    found = set().union(*map(read_in, texts))
    return [f"{member}: no code reads quality.{member}, so the knob does nothing"
            for member in members if member not in found]


def self_check():
    """The checker finds a knob that is named, written or copied into, and never read."""
    table = 'KNOB(int, sharpness, 1, "sharp", "", 0, 9, "0 9",  //\n'
    assert members_of(table + "// KNOB(int, gone, 1)\n") == ["sharpness"]
    silent = ["// quality.sharpness", "quality.sharpness = 3;", "int sharpness = 4;", "q.sharpness",
              "quality.sharpness_of()"]
    faults = [f"let through: {text}" for text in silent if not unread(["sharpness"], [text])]
    for text in ("f(scene.options.quality.sharpness);", "if (quality_.sharpness == 3)"):
        faults += unread(["sharpness"], [text])
    return faults


def main():
    members = members_of((ROOT / "runtime/scene/quality/knobs.def").read_text())
    cases = [(f"each of {len(members)} knobs is read", unread(members, sources())),
             ("the table has knobs", [] if members else ["no row was found"]),
             ("the checker finds planted faults", self_check())]
    return report(cases)


if __name__ == "__main__":
    sys.exit(main())
