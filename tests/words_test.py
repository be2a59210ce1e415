#!/usr/bin/env python3
"""tests/words_test.py: no sentence of the pages below has more than 30 words.

    tests/words_test.py            # checks the pages in PAGES; exit 1 with file:line of each fault
    tests/words_test.py FILE...    # checks these files instead

Code blocks, diagrams and addresses of links do not count. An inline `code span` counts as one word.
A heading, a list item and a table cell each end a sentence. Broken links between pages are faults too.
"""
import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
LIMIT = 30
PAGES = ["README.md", "ARCHITECTURE.md", "CONTRIBUTING.md", "CHANGELOG.md", "docs/*.md", "tests/*/*/README.md"]

CODE_SPAN = re.compile(r"(`+)(.+?)\1")
PICTURE = re.compile(r"!\[([^\]]*)\]\([^)]*\)")
LINK = re.compile(r"\[([^\]]*)\]\(([^)]*)\)")
# A new block: a heading, a list item or a quotation.
BLOCK = re.compile(r"\s*(#{1,6}\s|[-*+]\s|\d+[.)]\s|>)")
SENTENCE_END = re.compile(r"""[.!?]["')*_]*(?=\s|$)""")
ABBREVIATION = re.compile(r"(?:\b(?:e\.g|i\.e|etc|cf|vs|no|approx)|\b[A-Z])\.$")


def blocks(lines):
    """Runs of prose as lists of (line number, text): paragraphs, items, headings, table cells."""
    run, fence = [], None
    for number, line in enumerate(lines, 1):
        mark = re.match(r"\s*(```+|~~~+)", line)
        if mark and (fence is None or line.strip().startswith(fence)):
            fence = mark.group(1) if fence is None else None
            yield run
            run = []
            continue
        if fence is not None:
            continue
        indented_code = line.startswith("    ") and not run
        if not line.strip() or indented_code:
            yield run
            run = []
        elif line.lstrip().startswith("|"):
            yield run
            run = []
            for cell in re.split(r"(?<!\\)\|", line.strip().strip("|")):
                yield [(number, cell)]
        else:
            if BLOCK.match(line):
                yield run
                run = []
            run.append((number, BLOCK.sub("", line, count=1) if BLOCK.match(line) else line))
            if re.match(r"#{1,6}\s", line):
                yield run
                run = []
    yield run


def sentences(run):
    """(line number, text) of each sentence of one run."""
    # Code spans and links may cross a line's end, so markup is taken off the joined text; a marker
    # that is no word keeps each line's number.
    joined = " ".join(f"\x00{number}\x00 {text}" for number, text in run)
    joined = CODE_SPAN.sub(lambda m: " ".join(re.findall(r"\x00\d+\x00", m[0]) + ["code"]), joined)
    joined = LINK.sub(r"\1", PICTURE.sub(r"\1", joined))
    line, words = run[0][0], []
    start = line
    for token in joined.split():
        mark = re.fullmatch(r"\x00(\d+)\x00", token)
        if mark:
            line = int(mark[1])
            continue
        if not re.search(r"\w", token):
            continue
        if not words:
            start = line
        words.append(token)
        if SENTENCE_END.search(token) and not ABBREVIATION.search(token):
            yield start, words
            words = []
    if words:
        yield start, words


def long_sentences(text):
    """(line number, number of words, how it begins) of each sentence over the limit."""
    found = []
    for run in blocks(text.splitlines()):
        if not run:
            continue
        for line, words in sentences(run):
            if len(words) > LIMIT:
                found.append((line, len(words), " ".join(words[:8])))
    return found


def broken_links(path, text):
    """(line number, target) of links to files that are not there."""
    without_code = re.sub(r"```.*?```", lambda m: "\n" * m[0].count("\n"), text, flags=re.S)
    for match in LINK.finditer(without_code):
        target = match[2].split("#")[0]
        if not target or re.match(r"[a-z]+:", target):
            continue
        if not (path.parent / target).exists():
            yield without_code.count("\n", 0, match.start()) + 1, match[2]


def self_check():
    """The checker finds what is put before it, and nothing else."""
    long = " ".join(["word"] * (LIMIT + 1)) + "."
    short = " ".join(["word"] * LIMIT) + "."
    cases = [
        (f"{long}\n", 1), (f"{short} {short}\n", 0), (f"Text.\n\n```\n{long}\n```\n", 0),
        (f"- {long}\n- {short}\n", 1), (f"| {short} | {long} |\n", 1),
        ("word `a b c`\n" * 15 + "\n", 0), (f"{short[:-5]} `a`. {short}\n", 0), ("word\n" * 31, 1), (f"# Head\n{short}\n", 0),
    ]
    return [f"{text[:20]!r}: found {len(long_sentences(text))}, expected {count}"
            for text, count in cases if len(long_sentences(text)) != count]


def main():
    named = [Path(a) for a in sys.argv[1:]]
    files = named or sorted({f for page in PAGES for f in ROOT.glob(page)})
    faults = [f"tests/words_test.py: self check: {fault}" for fault in self_check()]
    for page in [] if named else PAGES:
        if not list(ROOT.glob(page)):
            faults.append(f"{page}: is not there")
    for file in files:
        text = file.read_text()
        name = file.relative_to(ROOT) if file.is_relative_to(ROOT) else file
        faults += [f"{name}:{line}: {count} words in one sentence: {begin} ..."
                   for line, count, begin in long_sentences(text)]
        faults += [f"{name}:{line}: no such file: {target}" for line, target in broken_links(file, text)]
    for fault in faults:
        print(fault)
    print(f"{len(files)} pages, {len(faults)} faults")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
