#!/usr/bin/env python3
"""tests/layering_test.py: includes between rooms are those that the CMake link lines name.

A room is a folder with a target. Each source file belongs to the longest room above it. It may
include its own room and those that the room's CMake line names, no more: a name there is a line of
the architecture. Rooms have no cycle and list at most 40 files of code. No part of the runtime includes
or links a later one. Private headers (*_p.h) stay
in their top-level folder, its tests, the fuzzers and the benchmarks; packages that stand behind one
file are included there alone.
"""
import os
import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from gauge import report  # noqa: E402

ROOT = Path(sys.argv[1] if len(sys.argv) > 1 else Path(__file__).parent.parent).resolve()
SOURCE_FOLDERS = ("runtime", "collada", "rsl", "jit", "anim", "skin", "raytrace", "tests")
LEAVES = ("jit", "anim", "skin", "collada", "raytrace")
INCLUDE = re.compile(r'^\s*#\s*include\s+(["<])([^">]+)[">]', re.M)
# The parts of the runtime, each above those before it.
PARTS = ("runtime/base", "runtime/scene", "runtime/picture", "runtime/kinora", "runtime/ri", "runtime/player",
         "runtime/programs")
MOST_FILES = 40

# Packages behind few files: header pattern -> files that may.
PACKAGES = {
    r"asmjit/": r"jit/(x64|a64)/.*",
    r"embree3/": r"raytrace/embree(_p\.h|\.cpp)|tests/bench/.*",
    r"expat\.h": r"collada/document/.*|tests/.*",
    r"fast_float/": r"collada/text/numbers\.cpp|tests/bench/.*",
    r"dtl/": r"runtime/programs/validate/unified_diff\.cpp",
    r"utf8\.h": r"runtime/base/text_encoding\.cpp|runtime/programs/validate/escaped_text\.cpp",
    r"libxml/": r"runtime/programs/validate/libxml_p\.h",
    r"OpenImageIO/": r"runtime/base/images_module/.*|tests/.*",
    r"Imf": r"runtime/base/exr_module/.*|tests/.*",
    r"png\.h": r"runtime/scene/images/libpng_p\.h",
    r"zip\.h": r"collada/document/libzip_p\.h|tests/.*",
    r"dlfcn\.h": r"runtime/base/shared_library\.cpp|tests/.*",
    r"CLI/": r"runtime/programs/.*",
    r"tiny_gltf": r"runtime/scene/gltf/file/(file\.h|tinygltf\.cpp)",
    r"SDL|imgui": r"runtime/programs/.*|tests/bench/play_raster_bench.*",
    r"llvm": r"(?!)",
}


class Target:
    def __init__(self, name, folder):
        self.name, self.folder, self.links = name, folder, []
        self.umbrella = False  # an INTERFACE target with links: they count as those of who names it


def commands(text):
    """(command, words) of a CMakeLists.txt, comments left out, plain variables put in."""
    text = re.sub(r"#[^\n]*", "", text)
    for name, value in re.findall(r"\bset\(\s*(\w+)\s+([^()\"]*?)\)", text):
        text = text.replace("${" + name + "}", value)
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
            if command in ("kinora_library", "kinora_program"):
                name = ("kinora_" if command == "kinora_library" else "") + words[0]
                target = targets.setdefault(name, Target(name, folder))
                target.links += after(words[1:], {"LINK", "PRIVATE"},
                                      {"SOURCES", "LINK", "PRIVATE"})
            elif command in ("add_library", "add_executable"):
                target = targets.setdefault(words[0], Target(words[0], folder))
                target.umbrella = "INTERFACE" in words
            elif command == "add_dependencies" and words[0] in targets:
                targets[words[0]].links += words[1:]
            elif command == "target_link_libraries" and words[0] in targets:
                targets[words[0]].links += [w for w in words[1:] if not w.isupper()]
    return targets


def named_folders(target, targets):
    """Folders of the targets that a target names, umbrellas opened."""
    folders = set()
    for link in target.links:
        if link not in targets:
            continue
        if targets[link].umbrella and targets[link].links:
            folders |= named_folders(targets[link], targets)
        else:
            folders.add(targets[link].folder)
    return folders


def folder_rules(targets):
    """folder -> folders it may include."""
    rules = {}
    for target in targets.values():
        if not target.umbrella or not target.links:
            allowed = rules.setdefault(target.folder, {target.folder})
            allowed |= named_folders(target, targets)
    return rules


def reachable(folder, rules, seen=None):
    seen = set() if seen is None else seen
    for other in rules.get(folder, set()) - {folder} - seen:
        seen.add(other)
        reachable(other, rules, seen)
    return seen


def library_of(folder):
    """The top-level folder in which a room's private headers may be included."""
    return "/".join(folder.split("/")[:2 if folder.startswith("runtime/programs") else 1])


def height(folder):
    """The number of a runtime folder's part; -1 of the other libraries."""
    part = "/".join(folder.split("/")[:2])
    return PARTS.index(part) if part in PARTS else -1


def is_above(folder, other):
    """Whether a folder belongs to a later part of the runtime than the other; of libraries that are
    no part of it, all but the base is above."""
    return height(folder) > max(height(other), 0)


def folder_of(path, folders):
    """The longest target folder above a file, "" if there is none."""
    fits = [f for f in folders if path.startswith(f + "/")]
    return max(fits, key=len, default="")


def source_files(endings=(".h", ".cpp", ".def")):
    for top in SOURCE_FOLDERS:
        for folder, _, names in os.walk(ROOT / top):
            for name in sorted(names):
                if name.endswith(endings):
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
        library = library_of(folder)
        mirrored = path.startswith((f"tests/{library}/", "tests/bench/", "tests/fuzzers/"))
        if header.endswith("_p.h") and library != library_of(own) and not mirrored:
            faults.append(where + f"{header} is private to {library}")
        if not is_test and folder and own and folder not in rules[own]:
            faults.append(where + f"{own} does not name {folder} in CMake, but includes {header}")
        if not is_test and own and is_above(folder, own):
            faults.append(where + f"{header} is of a part above {own}")
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
    yield "every source file belongs to a room", orphans
    base = rules.get("runtime/base", set())
    yield "runtime/base includes no other folder", sorted(base - {"runtime/base"})
    yield "rooms have no cycle", [f"{room} reaches itself" for room in sorted(rules)
                                  if room in reachable(room, rules)]
    yield "no part of the runtime links one above it", [
        f"{room} names {other}" for room in sorted(rules) for other in sorted(rules[room])
        if is_above(other, room)]
    yield "every room of the runtime belongs to a part", [
        room for room in sorted(rules) if room.startswith("runtime/") and height(room) < 0]
    leaves = []
    for room in rules:
        strangers = {library_of(r) for r in reachable(room, rules)} - {library_of(room), "runtime"}
        if library_of(room) in LEAVES and strangers:
            leaves.append(f"{room} reaches {sorted(strangers)}")
    yield "the leaves do not know each other", leaves
    known = {library_of(r) for room in rules if library_of(room) == "rsl"
             for r in reachable(room, rules)}
    yield "rsl knows jit and base only", sorted(known - {"rsl", "jit", "runtime"})
    yield f"no folder lists more than {MOST_FILES} files of code", crowded_folders()


def crowded_folders():
    counts = {}
    for path in source_files((".h", ".cpp", ".def", ".py")):
        folder = os.path.dirname(path)
        counts[folder] = counts.get(folder, 0) + 1
    return [f"{folder}: {count}" for folder, count in sorted(counts.items()) if count > MOST_FILES]


def self_check(rules):
    """The checker finds what is put before it."""
    wrong = [
        ("jit/ir/x.cpp", '#include "rsl/compile.h"\n', "does not name"),
        ("jit/ir/x.cpp", '#include "jit/passes/passes.h"\n', "does not name"),
        ("rsl/syntax/x.cpp", '#include "rsl/check/check.h"\n', "does not name"),
        ("runtime/base/x.cpp", '#include "jit/ir/ir.h"\n', "does not name"),
        ("anim/x.cpp", '#include "skin/skin.h"\n', "does not name"),
        ("rsl/lower/x.cpp", '#include "jit/interp/interp_p.h"\n', "private"),
        ("runtime/picture/frame/x.cpp", "#include <asmjit/x86.h>\n", "only by"),
        ("raytrace/film.cpp", "#include <embree3/rtcore.h>\n", "only by"),
        ("jit/ir/x.cpp", '#include "ir.h"\n', "not a path"),
        ("runtime/scene/x.cpp", '#include "runtime/picture/frame/frame.h"\n', "a part above"),
        ("runtime/picture/frame/x.cpp", '#include "runtime/player/player.h"\n', "a part above"),
        ("rsl/lower/x.cpp", '#include "runtime/scene/scene.h"\n', "a part above"),
    ]
    faults = []
    for path, text, expected in wrong:
        found, _ = check_includes(path, text, rules)
        if not any(expected in fault for fault in found):
            faults.append(f"{path}: {text.strip()} was let through")
    right, _ = check_includes("rsl/lower/x.cpp", '#include "jit/ir/ir.h"\n#include <vector>\n',
                              rules)
    return faults + right


def main():
    targets = read_targets()
    rules = folder_rules(targets)
    cases = list(test_cases(rules))
    cases.append(("the checker finds planted faults", self_check(rules)))
    return report(cases)


if __name__ == "__main__":
    sys.exit(main())
