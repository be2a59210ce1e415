#!/usr/bin/env python3
"""tests/layering_test.py: includes between folders are those that the CMake link lines allow.

Each source file belongs to the longest target folder above it. A target may include its own folder
and those of the targets it links, directly or through them, and that of a module it opens
(add_dependencies). Private headers (*_p.h) stay in their folder, its tests, the fuzzers and the benchmarks;
packages that stand behind one file are included there alone.
"""
import os
import re
import sys
from pathlib import Path

ROOT = Path(sys.argv[1] if len(sys.argv) > 1 else Path(__file__).parent.parent).resolve()
SOURCE_FOLDERS = ("runtime", "collada", "rsl", "jit", "anim", "skin", "raytrace", "tests")
LEAVES = ("jit", "anim", "skin", "collada", "raytrace")
INCLUDE = re.compile(r'^\s*#\s*include\s+(["<])([^">]+)[">]', re.M)

# Packages behind few files (DESIGN.md decisions 14, 19, 21): header pattern -> files that may.
PACKAGES = {
    r"asmjit/": r"jit/(x64|a64)/.*|jit/compiler\.cpp|jit/code_memory\.(h|cpp)",
    r"embree3/": r"raytrace/embree(_p\.h|\.cpp)|tests/bench/.*",
    r"expat\.h": r"collada/.*|tests/.*",
    r"libxml/": r"runtime/programs/foreign_schema\.cpp",
    r"OpenImageIO/": r"runtime/images_module/.*|tests/.*",
    r"CLI/": r"runtime/programs/.*",
    r"tiny_gltf": r"runtime/(import_gltf_file\.h|tinygltf\.cpp)",
    r"SDL|imgui": r"runtime/programs/.*",
    r"llvm": r"(?!)",
}


class Target:
    def __init__(self, name, folder):
        self.name, self.folder, self.links = name, folder, []


def commands(text):
    """(command, words) of a CMakeLists.txt, comments left out."""
    text = re.sub(r"#[^\n]*", "", text)
    for name, body in re.findall(r"(\w+)\s*\(([^()]*)\)", text):
        yield name, body.split()


def after(words, keywords, all_keywords):
    found, taking = [], False
    for word in words:
        if word in all_keywords:
            taking = word in keywords
        elif taking:
            found.append(word)
    return found


def read_targets():
    """Targets by name, from kinora_library, add_library and target_link_libraries lines."""
    targets = {}
    for file in sorted(ROOT.glob("**/CMakeLists.txt")):
        folder = file.parent.relative_to(ROOT).as_posix()
        if folder == "." or folder.startswith(("build", ".", "tests")):
            continue
        for command, words in commands(file.read_text()):
            if not words or "${" in words[0] or words[0].startswith("$"):
                continue
            if command == "kinora_library":
                name = "kinora_" + words[0]
                target = targets.setdefault(name, Target(name, folder))
                target.links += after(words[1:], {"LINK", "PRIVATE"},
                                      {"SOURCES", "LINK", "PRIVATE"})
            elif command in ("add_library", "add_executable"):
                targets.setdefault(words[0], Target(words[0], folder))
            elif command == "add_dependencies" and words[0] in targets:
                targets[words[0]].links += words[1:]
            elif command == "target_link_libraries" and words[0] in targets:
                targets[words[0]].links += [w for w in words[1:] if w not in ("PUBLIC", "PRIVATE")]
    return targets


def reachable(name, targets, seen=None):
    seen = set() if seen is None else seen
    if name in targets and name not in seen:
        seen.add(name)
        for link in targets[name].links:
            reachable(link, targets, seen)
    return seen


def folder_rules(targets):
    """folder -> folders it may include."""
    rules = {}
    for target in targets.values():
        allowed = rules.setdefault(target.folder, {target.folder})
        for name in reachable(target.name, targets):
            allowed.add(targets[name].folder)
    return rules


def folder_of(path, folders):
    """The longest target folder above a file, "" if there is none."""
    fits = [f for f in folders if path.startswith(f + "/")]
    return max(fits, key=len, default="")


def source_files():
    for top in SOURCE_FOLDERS:
        for folder, _, names in os.walk(ROOT / top):
            for name in sorted(names):
                if name.endswith((".h", ".cpp", ".def")):
                    yield (Path(folder) / name).relative_to(ROOT).as_posix()


def check_includes(path, text, rules):
    """Faults of one file, and how many includes were checked."""
    own = folder_of(path, rules)
    is_test = path.startswith("tests/")
    faults, count = [], 0
    for match in INCLUDE.finditer(text):
        count += 1
        quoted, header = match.group(1) == '"', match.group(2)
        line = text.count("\n", 0, match.start()) + 1
        where = f"{path}:{line}: "
        for pattern, files in PACKAGES.items():
            if re.match(pattern, header) and not re.fullmatch(files, path):
                faults.append(where + f"<{header}> may be included only by {files}")
        if not quoted:
            continue
        if not (ROOT / header).exists():
            if is_test:  # beside the test, or generated
                continue
            faults.append(where + f'"{header}" is not a path from the root')
            continue
        folder = folder_of(header, rules)
        if header.startswith("tests/") and not is_test:
            faults.append(where + f"{header}: a test's header")
        mirrored = path.startswith((f"tests/{folder}/", "tests/bench/", "tests/fuzzers/"))
        if header.endswith("_p.h") and folder != own and not mirrored:
            faults.append(where + f"{header} is private to {folder}")
        if not is_test and folder and own and folder not in rules[own]:
            faults.append(where + f"{own} does not link {folder}, but includes {header}")
    return faults, count


def test_cases(rules):
    """(name, faults) of every claim."""
    by_folder = {folder: [] for folder in rules}
    by_folder["tests"] = []
    counts = dict.fromkeys(by_folder, 0)
    orphans = []
    for path in source_files():
        text = (ROOT / path).read_text(errors="replace")
        faults, count = check_includes(path, text, rules)
        key = "tests" if path.startswith("tests/") else folder_of(path, rules)
        if not key:
            orphans.append(path)
            continue
        by_folder[key] += faults
        counts[key] += count
    for folder, faults in sorted(by_folder.items()):
        links = ", ".join(sorted(rules.get(folder, set()) - {folder})) or "nothing"
        name = f"{folder} includes {links}"
        if folder == "tests":
            name = "tests: private headers and packages"
        yield f"{name} ({counts[folder]} includes)", faults
    yield "every source file belongs to a target's folder", orphans
    base = rules.get("runtime/base", set())
    yield "runtime/base includes no other folder", sorted(base - {"runtime/base"})
    leaves = [f"{leaf} reaches {sorted(rules[leaf])}" for leaf in LEAVES
              if leaf in rules and rules[leaf] != {leaf, "runtime/base"}]
    yield "the leaves do not know each other", leaves
    rsl = rules.get("rsl", set()) - {"rsl", "jit", "runtime/base"}
    yield "rsl knows jit and base only", sorted(rsl)


def self_check(rules):
    """The checker finds what is put before it."""
    wrong = [
        ("jit/x.cpp", '#include "rsl/shader.h"\n', "does not link"),
        ("runtime/base/x.cpp", '#include "jit/ir.h"\n', "does not link"),
        ("anim/x.cpp", '#include "skin/skin.h"\n', "does not link"),
        ("rsl/x.cpp", '#include "jit/interp_p.h"\n', "private"),
        ("runtime/x.cpp", "#include <asmjit/x86.h>\n", "only by"),
        ("raytrace/film.cpp", "#include <embree3/rtcore.h>\n", "only by"),
        ("jit/x.cpp", '#include "ir.h"\n', "not a path"),
    ]
    faults = []
    for path, text, expected in wrong:
        found, _ = check_includes(path, text, rules)
        if not any(expected in fault for fault in found):
            faults.append(f"{path}: {text.strip()} was let through")
    right, _ = check_includes("rsl/x.cpp", '#include "jit/ir.h"\n#include <vector>\n', rules)
    return faults + right


def main():
    targets = read_targets()
    rules = folder_rules(targets)
    cases = list(test_cases(rules))
    cases.append(("the checker finds planted faults", self_check(rules)))
    failed = 0
    for name, faults in cases:
        print(f"{'FAILED' if faults else 'ok    '} {name}")
        for fault in faults:
            print(f"    {fault}")
        failed += bool(faults)
    print(f"{len(cases) - failed} passed, {failed} failed")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
