#!/usr/bin/env python3
"""tests/promises/promises.py: the table of numerical promises against the tests that hold them.

    promises.py             # checks the table; exit 1 where a promise has no test
    promises.py --markdown  # prints docs/promises.md (scripts/docs)
"""
import os
import re
import sys
from collections import namedtuple
from pathlib import Path

HERE = Path(__file__).resolve().parent
TABLE = HERE / "promises.table"
TESTS = HERE.parent
# Suites of which each test stands for a promise.
SUITES = ("Extremes", "SamplerExtremes", "SkinExtremes", "ExtremeMesh", "RenderExtremes", "LongSources", "FarAndSmall",
          "Cracks", "SkinTwist")
TIERS = ("precise", "fast", "both", "-")

Promise = namedtuple("Promise", "line case outcome tier tests")


def read_table(text):
    """Sections [(title, [Promise])], and what is wrong with the table."""
    sections, wrong = [], []
    for number, line in enumerate(text.splitlines(), 1):
        if not line.strip() or line.startswith("#"):
            continue
        if line.startswith("== "):
            sections.append((line[3:].strip(), []))
            continue
        parts = [part.strip() for part in line.split(" | ")]
        if len(parts) != 4 or not all(parts) or not sections:
            wrong.append(f"{number}: expected 'case | outcome | tier | tests' below a '== title'")
            continue
        promise = Promise(number, parts[0], parts[1], parts[2], parts[3].split())
        if promise.tier not in TIERS:
            wrong.append(f"{number}: the tier is one of {', '.join(TIERS)}, not '{promise.tier}'")
        sections[-1][1].append(promise)
    return sections, wrong


def test_programs():
    """Of each test source, whether its program makes code or numbers, so that AArch64 runs it too."""
    on_arm = {}
    for cmake in TESTS.rglob("CMakeLists.txt"):
        for block in re.findall(r"kinora_test\((?!NAME)([^()]*)\)", cmake.read_text()):
            for word in block.split():
                if word.endswith(".cpp"):
                    on_arm[(cmake.parent / word).resolve()] = "RUNS_CODE" in block.split()
    return on_arm


def known_tests():
    """Name of each test -> whether AArch64 runs it; of Python's, file.py:test_name."""
    names = {}
    programs = test_programs()
    for path in TESTS.rglob("*.cpp"):
        for suite, name in re.findall(r"^TEST(?:_P|_F)?\((\w+), (\w+)\)", path.read_text(), re.M):
            key = f"{suite}.{name}"
            names[key] = names.get(key, False) or programs.get(path.resolve(), False)
    for path in (TESTS / "programs").rglob("*.py"):
        for name in re.findall(r"^    def (test_\w+)\(self", path.read_text(), re.M):
            names[f"{path.name}:{name}"] = False
    return names


def check(sections, tests):
    """What is wrong: promises whose test is not there, and tests of extremes that no promise names."""
    named = {test for _, promises in sections for promise in promises for test in promise.tests}
    wrong = [f"{promise.line}: there is no test '{test}' for '{promise.case}'"
             for _, promises in sections for promise in promises for test in promise.tests if test not in tests]
    wrong += [f"no promise names the test '{test}'" for test in sorted(tests)
              if test.split(".")[0] in SUITES and test not in named]
    return wrong


def markdown(sections, tests):
    lines = ["# Numerical promises", "",
             "What holds at the extremes, with the tests that hold it. `tests/promises/promises.table` is its source.",
             "Tests in *italics* run on AArch64 too. [numerics.md](numerics.md) has the reasons.",
             "The precise tier gives the same bits on every target.", ""]
    for title, promises in sections:
        lines += [f"## {title}", "", "| case | what holds | tier | tests |", "|---|---|---|---|"]
        for p in promises:
            shown = ", ".join(f"*{test}*" if tests.get(test) else test for test in p.tests)
            lines.append(f"| {p.case} | {p.outcome} | {'' if p.tier == '-' else p.tier} | {shown} |")
        lines.append("")
    return "\n".join(lines[:-1])


def main():
    sections, wrong = read_table(TABLE.read_text())
    tests = known_tests()
    if sys.argv[1:] == ["--markdown"]:
        print(markdown(sections, tests))
        return 0
    wrong += check(sections, tests)
    # The check itself must be able to fail.
    spoiled, _ = read_table(TABLE.read_text().replace("Extremes.PowOf0", "Extremes.PowOfNought"))
    if len(check(spoiled, tests)) < len(check(sections, tests)) + 2:
        wrong.append("a promise without its test was not noticed")
    for line in wrong:
        print(f"{os.path.relpath(TABLE)}:{line}", file=sys.stderr)
    count = sum(len(promises) for _, promises in sections)
    print(f"{count} promises, {len({t for _, ps in sections for p in ps for t in p.tests})} tests")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
