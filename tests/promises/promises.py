#!/usr/bin/env python3
"""tests/promises/promises.py: the table of numerical promises against the tests that hold them.

    promises.py             # checks the table; exit 1 where a promise has no test. The build runs it
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
          "Cracks", "SkinTwist", "RiExtremes", "LightExtremes")
TIERS = ("precise", "fast", "both", "-")
# Stages that machine code or intrinsics are made for: their tests run on AArch64 too.
PORTED = {"jit", "rsl", "anim", "skin"}
# Cases whose outcome is a finding have a row in its table, which starts with their number.
FINDINGS = TESTS / "programs/render/extreme_findings_test.py"
FINDINGS_TEST = f"{FINDINGS.name}:test_code_place_and_severity"
# The cases that were listed before any of them was built. Each has a row; later rows need no number.
CASES = range(1, 95)

Promise = namedtuple("Promise", "line numbers stages case outcome tier tests")
# Of a test: the folder of tests that it stands in, and whether AArch64 runs it too.
Test = namedtuple("Test", "stage on_arm")


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
        if len(parts) != 6 or not all(parts) or not sections or not re.fullmatch(r"-|\d+( \d+)*", parts[0]):
            wrong.append(f"{number}: expected 'numbers | stages | case | outcome | tier | tests' below a '== title'")
            continue
        numbers, stages, tests = ([word for word in parts[k].split() if word != "-"] for k in (0, 1, 5))
        promise = Promise(number, list(map(int, numbers)), stages, *parts[2:5], tests)
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


def stage_of(path):
    """"rsl" for a test of the folder tests/rsl."""
    return path.relative_to(TESTS).parts[0]


def known_tests():
    """Name of each test -> Test; of Python's, file.py:test_name."""
    names = {}
    programs = test_programs()
    for path in TESTS.rglob("*.cpp"):
        for suite, name in re.findall(r"^TEST(?:_P|_F)?\((\w+), (\w+)\)", path.read_text(), re.M):
            key = f"{suite}.{name}"
            on_arm = programs.get(path.resolve(), False)
            names[key] = Test(stage_of(path), on_arm or (key in names and names[key].on_arm))
    for path in (TESTS / "programs").rglob("*.py"):
        for name in re.findall(r"^    def (test_\w+)\(self", path.read_text(), re.M):
            names[f"{path.name}:{name}"] = Test("programs", False)
    return names


def check(sections, tests):
    """What is wrong: promises whose test is not there, tests of extremes that no promise names, cases without a row."""
    rows = [promise for _, promises in sections for promise in promises]
    named = {test for promise in rows for test in promise.tests}
    wrong = [f"{p.line}: there is no test '{test}' for '{p.case}'" for p in rows for test in p.tests if test not in tests]
    wrong += [f"no promise names the test '{test}'" for test in sorted(tests)
              if test.split(".")[0] in SUITES and test not in named]
    numbers = {number for p in rows for number in p.numbers}
    wrong += [f"case {number} stands in no row" for number in CASES if number not in numbers]
    wrong += [f"{p.line}: there is no case {number}" for p in rows for number in p.numbers if number not in CASES]
    wrong += [f"{p.line}: '{p.case}' has no test; where a case concerns nothing, the outcome begins with 'nothing:'"
              for p in rows if not p.tests and not p.outcome.startswith("nothing:")]
    for p in rows:
        known = [tests[t] for t in p.tests if t in tests]
        there = {t.stage for t in known}
        wrong += [f"{p.line}: no test of '{p.case}' stands in tests/{stage}" for stage in p.stages if stage not in there]
        wrong += [f"{p.line}: '{p.case}' has a test of the stage '{stage}' without naming it"
                  for stage in sorted(there - set(p.stages))]
        wrong += [f"{p.line}: no test of '{p.case}' in tests/{stage} runs on AArch64" for stage in p.stages
                  if stage in PORTED and stage in there and not any(t.on_arm for t in known if t.stage == stage)]
    of_findings = set(map(int, re.findall(r'^    \((\d+), "', FINDINGS.read_text(), re.M)))
    told = {number for p in rows if FINDINGS_TEST in p.tests for number in p.numbers}
    wrong += [f"case {number} has a finding in {FINDINGS.name}, which no row of it names"
              for number in sorted(of_findings - told)]
    wrong += [f"case {number} has no finding in {FINDINGS.name}, which its row names" for number in sorted(told - of_findings)]
    return wrong


def markdown(sections, tests):
    lines = ["# Numerical promises", "",
             "What holds at the extremes, with the tests that hold it. `tests/promises/promises.table` is its source.",
             "The column of numbers has those of the first list of cases, 1 to 94. Each of them has a row.",
             "Stages are the folders of `tests` whose stage the case concerns. Tests in *italics* run on AArch64 too.",
             "Where a tier is named, tests run on every target: interpreter, AVX2, AVX-512 and NEON.",
             "The precise tier gives the same bits on all of them. [numerics.md](numerics.md) has the reasons.", ""]
    for title, promises in sections:
        lines += [f"## {title}", "", "| | case | what holds | tier | stages | tests |", "|---|---|---|---|---|---|"]
        for p in promises:
            shown = ", ".join(f"*{t}*" if t in tests and tests[t].on_arm else t for t in p.tests)
            numbers, stages = ", ".join(map(str, p.numbers)), ", ".join(p.stages)
            lines.append(f"| {numbers} | {p.case} | {p.outcome} | {'' if p.tier == '-' else p.tier} | {stages} | {shown} |")
        lines.append("")
    return "\n".join(lines[:-1])


# What is wrong with the table, a change that makes it so, and how many lines more must tell it.
SPOILED = (
    ("a promise without its test", ("Extremes.PowOf0", "Extremes.PowOfNought"), 3),
    ("a case without a row", ("\n44 | ", "\n- | "), 1),
    ("a stage without a test", ("\n44 | rsl |", "\n44 | rsl runtime |"), 1),
    ("a stage that is not named", ("\n67 | rsl jit |", "\n67 | rsl |"), 1),
    ("a finding that is not looked for", ("\n37 | ", "\n37 48 | "), 1),
    ("a row without a test", ("Extremes.PowOfANegativeToAFractionIs0\n", "-\n"), 3),
)


def main():
    sections, wrong = read_table(TABLE.read_text())
    tests = known_tests()
    if sys.argv[1:] == ["--markdown"]:
        print(markdown(sections, tests))
        return 0
    wrong += check(sections, tests)
    # The check itself must be able to fail.
    for words, spoiled, more in SPOILED:
        text = TABLE.read_text()
        assert spoiled[0] in text, spoiled
        if len(check(read_table(text.replace(*spoiled, 1))[0], tests)) != len(check(sections, tests)) + more:
            wrong.append(f"{words} was not noticed")
    for line in wrong:
        print(f"{os.path.relpath(TABLE)}:{line}", file=sys.stderr)
    count = sum(len(promises) for _, promises in sections)
    print(f"{count} promises, {len({t for _, ps in sections for p in ps for t in p.tests})} tests")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
