#!/usr/bin/env python3
"""tests/cites_test.py: nothing in the tree cites what is not there.

- `docs/PAGE.md#heading`, anywhere in the tree, names a page and a heading of it.
- A `path/to/file` in a page names a file or a folder, or matches some (`rsl/builtins/*.cpp`).
- Nothing names the internal notes that the project was planned with.
Exit 1 with file:line of each fault.
"""
import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
PAGES = ["README.md", "ARCHITECTURE.md", "CONTRIBUTING.md", "docs/*.md"]
FOLDERS = ("runtime", "collada", "rsl", "jit", "anim", "skin", "raytrace", "tests", "assets", "scripts", "docs")
# Data, and this file, which must name what it looks for.
SKIPPED = re.compile(r".*\.(png|dae|glb|zae|kmz|gltf|exr|bin)$|tests/fuzzers/corpus/.*|tests/cites_test\.py$")

CITED = re.compile(r"docs/([\w-]+\.md)(#[\w-]+)?")
LINKED = re.compile(r"\]\(([\w./-]*\.md)?(#[\w-]+)\)")
SPAN = re.compile(r"`([^`\n]+)`")
NOTES = re.compile(r"\b(DESIGN|EXTREMES|RSL2?|COLLADA|PROGRAMS|STYLE)\.md\b|\b(DESIGN|EXTREMES) (section|row|\d)"
                   r"|\bdecisions? \d+\b|// (any x: )?rows? \d\d")


def tracked():
    names = subprocess.run(["git", "ls-files", "-z"], cwd=ROOT, capture_output=True, check=False).stdout
    if not names:  # not a clone: the files that are there
        return sorted(p.relative_to(ROOT).as_posix() for folder in FOLDERS
                      for p in (ROOT / folder).rglob("*") if p.is_file())
    return [n for n in names.decode().split("\0") if n and (ROOT / n).is_file()]


def anchors(page):
    """The headings of a page as they are linked to."""
    found, code = set(), False
    for line in page.read_text().splitlines():
        code ^= line.lstrip().startswith("```")
        heading = re.match(r"#{1,6}\s+(.*)", line)
        if heading and not code:
            words = re.sub(r"[^\w\- ]", "", heading[1].lower())
            found.add("#" + words.strip().replace(" ", "-"))
    return found


def wrong_headings(name, text, pages):
    for match in CITED.finditer(text):
        page, heading = match[1], match[2]
        if page not in pages:
            yield match.start(), f"no page docs/{page}"
        elif heading and heading not in pages[page]:
            yield match.start(), f"docs/{page} has no heading {heading}"
    if not name.endswith(".md"):
        return
    for match in LINKED.finditer(text):
        page = Path(name).parent / match[1] if match[1] else Path(name)
        known = pages.get(page.name) if (ROOT / page).parent.name == "docs" else anchors(ROOT / page)
        if known is not None and match[2] not in known:
            yield match.start(), f"{page} has no heading {match[2]}"


def wrong_paths(text):
    """Paths in code spans that lead nowhere."""
    for match in SPAN.finditer(re.sub(r"```.*?```", lambda m: "\n" * m[0].count("\n"), text, flags=re.S)):
        span = match[1].rstrip("/")
        if not re.fullmatch(r"[\w.*{},/-]+", span) or span.split("/")[0] not in FOLDERS or "/" not in span:
            continue
        if any(word in span for word in ("NAME", "CODE", "PAGE", "path/to", "{")):
            continue
        if not (list(ROOT.glob(span)) or list(ROOT.glob(span + ".*"))):
            yield text.count("\n", 0, text.find("`" + match[1] + "`")) + 1, f"no such file: {span}"


def main():
    pages = {page.name: anchors(page) for page in (ROOT / "docs").glob("*.md")}
    written = {p.relative_to(ROOT).as_posix() for pattern in PAGES for p in ROOT.glob(pattern)}
    faults, files = [], 0
    for name in tracked():
        if SKIPPED.match(name):
            continue
        files += 1
        text = (ROOT / name).read_text(errors="replace")
        found = [(text.count("\n", 0, at) + 1, what) for at, what in wrong_headings(name, text, pages)]
        found += [(text.count("\n", 0, m.start()) + 1, f"names an internal note: {m[0]}")
                  for m in NOTES.finditer(text)]
        if name in written:
            found += wrong_paths(text)
        faults += [f"{name}:{line}: {what}" for line, what in found]
    for fault in faults:
        print(fault)
    print(f"{files} files, {len(faults)} faults")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
