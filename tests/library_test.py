#!/usr/bin/env python3
"""tests/library_test.py: what code of the library leaves to the programs that use it.

A library reads numbers whatever the locale of its process is (runtime/base/numbers.h), prints
nothing, does not end the process and changes nothing that the whole process has. Exceptions are rows
of ALLOWED, each with its reason.
"""
import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from gauge import report  # noqa: E402

ROOT = Path(sys.argv[1] if len(sys.argv) > 1 else Path(__file__).parent.parent).resolve()
FOLDERS = ("jit", "rsl", "anim", "skin", "collada", "raytrace", "runtime")
PROGRAMS = "runtime/programs/"

# What is forbidden: name, pattern, whether in the programs too.
RULES = (
    ("numbers by the process's locale", r"\b(?:std::)?(?:strto(?:d|f|ld|l|ul|ll|ull)|v?f?sscanf|ato[fil]|"
     r"sto(?:[dfi]|ld|ul|ull|l)|setlocale)\s*\(", True),
    ("printing", r"\bstd::(?:cout|cerr|clog)\b|\b(?:std::)?(?:printf|putchar|puts)\s*\(|"
     r"\b(?:std::)?(?:fprintf|fputs|fputc|vfprintf)\s*\([^;]*\bstd(?:out|err)\b|\bfmt::print\s*\((?:std|\")",
     False),
    ("ending the process", r"\b(?:std::)?(?:exit|_exit|quick_exit|abort|terminate)\s*\(", False),
    ("changing the process", r"\b(?:setenv|putenv|unsetenv|chdir|umask|sigaction|signal|atexit)\s*\(", False),
)

ALLOWED = {
    "runtime/base/parallel.cpp": "the package that is missing, once",
    "raytrace/embree.cpp": "Embree's own faults",
    "jit/debug/jit_dump.cpp": "asked for by an environment variable",
    "jit/ir/builder.cpp": "ahead of a failed check",
    "runtime/scene/ri/calls/errors.cpp": "RiErrorPrint and RiErrorAbort, which a C program chooses",
    # Names of RSL's functions, not of C's.
    "rsl/builtins/string.cpp": "stof and printf of RSL",
    "rsl/model/string_functions.cpp": "stof of RSL",
}


def plain(text):
    """Code without comments and texts."""
    text = re.sub(r'"(?:[^"\\\n]|\\.)*"', '""', text)
    return re.sub(r"//[^\n]*", "", text)


def faults_of(path, text):
    code = plain(text)
    for name, pattern, everywhere in RULES:
        if path.startswith(PROGRAMS) and not everywhere:
            continue
        for match in re.finditer(pattern, code):
            line = code.count("\n", 0, match.start()) + 1
            yield f"{path}:{line}: {name}: {match.group(0).strip()}"


def sources():
    for folder in FOLDERS:
        for path in sorted((ROOT / folder).rglob("*")):
            if path.suffix in (".h", ".cpp"):
                yield path.relative_to(ROOT).as_posix(), path.read_text(errors="replace")


def self_check():
    planted = ("x = std::strtod(text, &end);", "std::printf(\"a\");", "std::fputs(a, stderr);",
               "std::exit(1);", "setenv(a, b, 1);", "n = std::stoi(text);", "sscanf(t, f, &x);",
               "std::cout << 1;")
    missed = [text for text in planted if not list(faults_of("rsl/x.cpp", text))]
    right = list(faults_of("rsl/x.cpp", "snprintf(a, 1, f); // exit(1)\nstd::fputs(a, file);\n"
                           "take_number<int>(t); visit(1); say(\"exit(1)\");"))
    in_programs = list(faults_of(PROGRAMS + "x.cpp", "std::printf(\"a\");"))
    return [f"let through: {text}" for text in missed] + right + in_programs


def main():
    found, unused = [], set(ALLOWED)
    for path, text in sources():
        faults = list(faults_of(path, text))
        if path in ALLOWED:
            if faults:
                unused.discard(path)
            continue
        found += faults
    return report([("the library leaves these to its programs", found),
                   ("every exception is one", sorted(unused)),
                   ("the checker finds planted faults", self_check())])


if __name__ == "__main__":
    sys.exit(main())
