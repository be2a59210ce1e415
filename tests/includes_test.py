#!/usr/bin/env python3
"""tests/includes_test.py: every file reaches the headers whose names it uses.

CI compiles the files of a room together, and there one file sees what another included; README's
build compiles each alone. So each .cpp must reach, by its includes, a header that declares the
functions, types and constants of ours that it names. This reads text, it is no compiler: names that
the file or a header it reaches has for something else are passed over. `scripts/nightly headers`
compiles all of them alone.
"""
import re
import sys
from functools import lru_cache
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from gauge import report  # noqa: E402

ROOT = Path(sys.argv[1] if len(sys.argv) > 1 else Path(__file__).parent.parent).resolve()
FOLDERS = ("runtime", "collada", "rsl", "jit", "anim", "skin", "raytrace", "tests")
INCLUDE = re.compile(r'^\s*#\s*include\s+"([^"]+)"', re.M)
FUNCTION = re.compile(r"^(?!using |return |static |\s|#)[\w:<>,&* \[\]]*?[\w>&*] +[&*]*([a-z_]\w*)\(", re.M)
TYPE = re.compile(r"^(?:class|struct|union|enum class|enum)\s+(?:alignas\([^)]*\)\s*)?(\w+)[^;]*?\{", re.M)
ALIAS = re.compile(r"^using (\w+) =|^(?:inline )?constexpr [\w:<>, ]+? (k\w+)\b", re.M)
OWN_CALL = r"[\w>&*\]]\s+[&*]*NAME\s*\(|\bauto[&*\s]+NAME\b|(define|using [\w:]+::) ?NAME\b"
OWN_WORD = r"[\w>&*\]]\s+[&*]*NAME\s*[({=;,):\[]|\b(class|struct|enum|using|typename|define|using [\w:]+::) ?NAME\b"
OF_C = {"open", "close", "read", "write", "kill", "alignas", "size_t", "float", "double", "uint8_t", "uint32_t"}
CALL = re.compile(r"(?<![\w.>:~])([a-z_]\w*)\(")
WORD = re.compile(r"(?<![\w.:~])([A-Zk]\w*)\b")


def bare(text):
    """C++ without comments, strings and characters."""
    text = re.sub(r'R"(\w*)\(.*?\)\1"', '""', text, flags=re.S)
    return re.sub(r"//[^\n]*|/\*.*?\*/|\"(?:\\.|[^\"\\\n])*\"|'(?:\\.|[^'\\\n])'",
                  lambda m: '""' if m.group().startswith('"') else " ", text, flags=re.S)


@lru_cache(None)
def read(path):
    return (ROOT / path).read_text(errors="replace")


@lru_cache(None)
def words(path):
    return frozenset(re.findall(r"\w+", bare(read(path))))


@lru_cache(None)
def includes(path):
    """Files of ours that one names; a header may stand beside it."""
    found = []
    for name in INCLUDE.findall(read(path)):
        for candidate in (name, (Path(path).parent / name).as_posix()):
            if (ROOT / candidate).is_file():
                found.append(candidate)
                break
    return found


def reached(path):
    seen, todo = set(), [path]
    while todo:
        for header in includes(todo.pop()):
            if header not in seen:
                seen.add(header)
                todo.append(header)
    return seen


def declared(path):
    """Names that a header declares at namespace level."""
    text = bare(read(path))
    text = re.sub(r"^template\s*<[^\n]*>\n", "", text, flags=re.M)
    names = set(FUNCTION.findall(text)) | set(TYPE.findall(text))
    return (names | {a or b for a, b in ALIAS.findall(text)}) - OF_C


def headers_of_names():
    """name -> headers that declare it. What a test declares is for tests."""
    table = {}
    for top in FOLDERS:
        for header in sorted((ROOT / top).glob("**/*.h")):
            path = header.relative_to(ROOT).as_posix()
            for name in declared(path):
                table.setdefault(name, []).append(path)
    return table


def faults_of(path, text, table, reach, beside):
    """Names of a file that no header it reaches has, and one that a file beside it reaches has."""
    text = re.sub(r"^(TEST|TEST_F|TEST_P|BENCHMARK\w*)\([^\n]*|benchmark::\w+", "", bare(text), flags=re.M)
    known = set().union(*(words(h) for h in reach)) if reach else set()
    faults = []
    for pattern, own in ((CALL, OWN_CALL), (WORD, OWN_WORD)):
        for match in pattern.finditer(text):
            name = match.group(1)
            if name in known or beside.isdisjoint(table.get(name, ())):
                continue
            if re.search(own.replace("NAME", name), text.replace("return ", "return;")):
                continue  # the file has a thing of its own by this name
            known.add(name)
            line = text.count("\n", 0, match.start()) + 1
            faults.append(f"{path}:{line}: {name} is of {' or '.join(table[name])}, not included")
    return faults


def sources():
    for top in FOLDERS:
        for file in sorted((ROOT / top).glob("**/*.cpp")):
            yield file.relative_to(ROOT).as_posix()


def self_check(table):
    """Finds a call, a type and a constant without their headers, and lets what is right through."""
    some = "runtime/scene/vertices/weld.h"
    planted = ("void f() { weld_of_ = weld(positions); }\n", "void f() { const Mesh mesh; }\n")
    beside = {some, "runtime/scene/shapes.h"}
    missed = [text for text in planted if not faults_of("x.cpp", text, table, set(), beside)]
    right = faults_of("x.cpp", planted[0], table, {some}, beside)
    return [f"let through: {text.strip()}" for text in missed] + right


def main():
    table = headers_of_names()
    reach = {path: reached(path) for path in sources()}
    beside = {}  # what the files of a folder reach together
    for path, headers in reach.items():
        beside.setdefault(Path(path).parent, set()).update(headers)
    faults, count = [], len(reach)
    for path, headers in reach.items():
        faults += faults_of(path, read(path), table, headers, beside[Path(path).parent])
    cases = [(f"{count} files reach the headers of the {len(table)} names they use", faults),
             ("the checker finds planted faults", self_check(table))]
    return report(cases)


if __name__ == "__main__":
    sys.exit(main())
