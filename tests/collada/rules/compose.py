#!/usr/bin/env python3
"""tests/collada/rules/compose.py FOLDER: writes the documents of all rules into FOLDER.

README.md explains the files. Everything is written into one flat folder, with what lies in beside/.
"""
import shutil
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
WHOLE = (".dae", ".zae", ".kmz")


class PatchError(Exception):
    pass


def read_patches(path):
    """[(document, origin, hunks)]; a hunk is a list of (sign, line)."""
    patches = []
    for number, line in enumerate(path.read_text(encoding="utf-8").split("\n"), 1):
        if line.startswith("--- "):
            origin = line[4:].split("\t")[0]  # before the date
        elif line.startswith("+++ "):
            patches.append((line[4:].split("\t")[0], origin, []))
        elif line.startswith("@@"):
            patches[-1][2].append([])
        elif line[:1] in (" ", "-", "+") and patches and patches[-1][2]:
            patches[-1][2][-1].append((line[0], line[1:]))
        elif line and not line.startswith("#"):
            raise PatchError(f"{path}:{number}: no line of a patch: {line}")
    return patches


def apply(hunks, lines):
    """The lines of the document. The old lines of each hunk stand at one place after the last hunk."""
    made, at = [], 0
    for hunk in hunks:
        old = [line for sign, line in hunk if sign in " -"]
        places = [i for i in range(at, len(lines) - len(old) + 1) if lines[i:i + len(old)] == old]
        if len(places) != 1 or not old:
            raise PatchError(f"found {len(places)} times, needed once:\n" + "\n".join(old))
        made += lines[at:places[0]] + [line for sign, line in hunk if sign in " +"]
        at = places[0] + len(old)
    return made + lines[at:]


def documents():
    """File name -> bytes: those that are kept whole, then those that patches make."""
    found = {}
    for path in sorted(HERE.glob("*/*")):
        if path.suffix in WHOLE and path.parent.name not in ("bases", "beside"):
            found[path.name] = path.read_bytes()
    for path in sorted(HERE.glob("*/*.diff")):
        for name, origin, hunks in read_patches(path):
            base = (HERE / origin).read_bytes() if origin.startswith("bases/") else found[origin]
            try:
                lines = apply(hunks, base.decode().split("\n"))
            except PatchError as error:
                raise PatchError(f"{path}: {name}: {error}") from None
            if name in found or name.split(".")[0] != path.stem:
                raise PatchError(f"{path}: {name}: there already, or of another code")
            found[name] = "\n".join(lines).encode()
    return found


def main():
    folder = Path(sys.argv[1])
    made = documents()
    shutil.rmtree(folder, ignore_errors=True)
    shutil.copytree(HERE / "beside", folder)
    for name, content in made.items():
        (folder / name).write_bytes(content)
    print(f"{len(made)} documents in {folder}")


if __name__ == "__main__":
    try:
        main()
    except PatchError as error:
        sys.exit(str(error))
