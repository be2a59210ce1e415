#!/usr/bin/env python3
"""tests/classes_test.py: no class is a program of its own.

A class or struct has its member functions in at most 4 files and at most 40 of them; a class has
at most 25 fields (structs are plain data). What is larger today stands in LARGER with its sizes,
which may shrink and never grow; the goal is an empty table. A name that two rooms use counts in
each room alone.
"""
import re
import sys
from pathlib import Path

ROOT = Path(sys.argv[1] if len(sys.argv) > 1 else Path(__file__).parent.parent).resolve()
FOLDERS = ("jit", "rsl", "collada", "anim", "skin", "raytrace", "runtime")
MOST = (4, 40, 25)  # files, functions, fields
LARGER = {
}

DEFINED = re.compile(
    r"^(?!\s|#|using |return |namespace |CHECK)[^;={}\"]*?\b([A-Z]\w*)::(?:~?\w+|operator[^\s(]+)\(",
    re.M)
HEAD = re.compile(r"^class(?:\s+alignas\([^)]*\))?\s+(\w+)(?:\s+final)?(?:\s*:[^{;]*)?\s*\{", re.M)
FIELD = re.compile(r"^[\w:<>,\s*&\[\].()]+?[\s*&>]\w+(?:\[[^\]]*\])*(?:\s*=[^;]*|\{[^;]*\})?;$")


def without_comments(text):
    text = re.sub(r"//[^\n]*", "", text)
    return re.sub(r"/\*.*?\*/", "", text, flags=re.S)


def body_of(text, start):
    """What stands between the braces that open before `start`, inner braces emptied."""
    depth, out = 1, []
    for c in text[start:]:
        depth += {"{": 1, "}": -1}.get(c, 0)
        if depth == 0:
            break
        if depth == 1 or (depth == 2 and c == "{"):
            out.append(c)
    return "".join(out)


def is_field(statement):
    if re.match(r"(using|friend|static|typedef|enum|template|public|private|struct|class)\b", statement):
        return False
    bare = re.sub(r"<[^;]*>", "", statement.split("=")[0].split("{")[0])
    return "(" not in bare and bool(FIELD.match(statement + ";"))


def fields_of(body):
    body = re.sub(r"\b(public|private|protected):", "", body)
    statements = [" ".join(s.split()) for s in re.split(r"[;}]", body)]
    count = 0
    for statement in statements:
        if statement and is_field(statement):
            count += 1 + len(re.findall(r",\s*\w+\s*(?:=|$|,|\{)", re.sub(r"<[^;]*>", "", statement)))
    return count


def measure():
    """(room, class) -> [files, functions, fields]."""
    files, functions, fields = {}, {}, {}
    for folder in FOLDERS:
        for path in sorted((ROOT / folder).rglob("*")):
            if path.suffix not in (".h", ".cpp"):
                continue
            text = without_comments(path.read_text(errors="replace"))
            room = path.parent.relative_to(ROOT).as_posix()
            for match in HEAD.finditer(text):
                key = room, match.group(1)
                fields[key] = max(fields.get(key, 0), fields_of(body_of(text, match.end())))
            if path.suffix == ".cpp":
                for match in DEFINED.finditer(text):
                    key = room, match.group(1)
                    files.setdefault(key, set()).add(path.name)
                    functions[key] = functions.get(key, 0) + 1
    keys = set(files) | set(fields)
    return {k: (len(files.get(k, ())), functions.get(k, 0), fields.get(k, 0)) for k in keys}


def main():
    faults, sizes = [], measure()
    for key, size in sorted(sizes.items()):
        allowed = LARGER.get("/".join(key), MOST)
        if any(have > most for have, most in zip(size, allowed)):
            faults.append(f"{'/'.join(key)}: {size} files, functions, fields; allowed: {allowed}")
    for name, allowed in LARGER.items():
        room, _, cls = name.rpartition("/")
        size = sizes.get((room, cls), (0, 0, 0))
        if all(have <= most for have, most in zip(size, MOST)):
            faults.append(f"{name} is small enough: {size}; take it out of LARGER")
    for fault in faults:
        print(fault)
    print(f"{len(sizes)} classes, {len(LARGER)} larger than they should be")
    print(f"{len(sizes) - len(faults)} passed, {len(faults)} failed")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
