#!/usr/bin/env python3
"""tests/first_look/first_look.py: counts the faults of first pictures, those that the defaults alone give.

    tests/first_look/first_look.py [PART ...] [--out FOLDER] [--against OLD.json] [--scale 20%] [--spp 4]
                                   [--build FOLDER] [--only GLOB ...] [--least 95]

Parts: corpus (written by corpus.py), blind (ten documents written without knowledge of the sources), stranger (written by the folder
stranger, whose author had not read the sources either), shared (../shared/scenes),
exporters (written by exporters.py with the packages that are installed), or a folder of documents of your own (a corpus.json in
it says what is expected). Without a part: corpus, blind, stranger and shared. One line a file: its fault and figures; then totals a group.
--out keeps pictures, first_look.json and sheets: the picture by default, and beside it a 50 % grey matte on everything. The exit
code is 1 where fewer than --least per cent of the files of all parts together are right, 77 where all parts are missing.

Faults: exit (not 0, or not 3 where there is nothing to draw or the version is not read), time (over 60 s), blank (under 0.2 % of the picture is covered), speck
(under 3 %), holes (less is covered than corpus.json says), white (over 60 % of what is covered is clipped), checks (over 2 % magenta
although the named image exists), black (under the grey matte over 30 % of what is covered is darker than sRGB 43, or over 95 % of the
picture itself than 8), colour (its red over its blue is less than corpus.json says: the wrong
material), silent (the document's own lights spoil it, and the text that corpus.json expects is not printed).
"""
import argparse
import concurrent.futures
import fnmatch
import json
import os
import re
import subprocess
import sys
import tempfile
import time
import zlib
from pathlib import Path
from urllib.parse import unquote

HERE = Path(__file__).resolve().parent
ROOT = Path(os.environ.get("KINORA_SOURCE_DIR", HERE.parent.parent)).resolve()
SHARED = Path(os.environ.get("KINORA_SHARED", ROOT.parent / "shared"))
sys.path[:0] = [str(HERE), str(ROOT / "scripts")]
import corpus  # noqa: E402
import stranger  # noqa: E402
from sheet import lettering, png  # noqa: E402

BLANK, SPECK, WHITE, CHECKS, BLACK, ALL_BLACK = 0.002, 0.03, 0.6, 0.02, 0.3, 0.95
CLIPPED, DARK, NIGHT = 253, 43, 8  # of 255
SECONDS = 60
WRITTEN = ("corpus", "stranger", "exporters")  # parts that a script writes
KINDS = ("exit", "time", "blank", "speck", "holes", "white", "checks", "black", "colour", "silent")
PAPER, INK, ALARM = (34, 34, 36), (225, 225, 220), (255, 90, 70)
COLUMNS, STRIP = 8, 14
# Parts of other documents; a reader's test whose triangles have no area.
NOT_SCENES = {
    "cts15_external_geometry/library_geometries.dae",
    "odd/external/parts.dae",
    "magnum_mesh_all_primitives/mesh-multiple-primitives.dae",
}
# Of ../shared/scenes. Three have only cameras or lights; one is as small in the conformance suite's own first picture; the lights of
# one leave most of it dark.
SHARED_EXPECTED = {
    "assimp_cameras/cameras.dae": {"nothing": True},
    "assimp_lights_blender/lights.dae": {"nothing": True},
    "magnum_lights/light.dae": {"nothing": True},
    "cts_anim_linear_step_bezier/LinearStepBezier.dae": {"small": True},
    "webglue_cat/cat.dae": {"told": "--lights both"},
}


def pixels(path):
    """(width, height, rows of RGBA bytes) of an 8-bit PNG."""
    data = path.read_bytes()
    parts = list(png.chunks(data))
    width, height = (int.from_bytes(parts[0][1][i : i + 4], "big") for i in (0, 4))
    step = {2: 3, 6: 4}[parts[0][1][9]]
    raw = zlib.decompress(b"".join(body for kind, body in parts if kind == b"IDAT"))
    rows, above = [], bytes(width * step)
    for y in range(height):
        at = y * (width * step + 1)
        above = png.unfilter(raw[at], bytearray(raw[at + 1 : at + 1 + width * step]), above, step)
        row = above
        if step == 3:
            row = bytearray(b"\xff" * (4 * width))
            for c in range(3):
                row[c::4] = above[c::3]
        rows.append(bytes(row))
    return width, height, rows


def figures(picture):
    """Shares: covered of all pixels; clipped, magenta and dark of what is covered by half and more.

    The checks of a missing image are pure: red and blue alike, no green but that of highlights. Violet has more."""
    width, height, rows = picture
    covered = solid = clipped = magenta = dark = night = red = blue = 0
    for row in rows:
        covered += sum(row[3::4])
        for r, g, b, a in zip(row[::4], row[1::4], row[2::4], row[3::4]):
            if a < 128:
                continue
            solid += 1
            red += r
            blue += b
            clipped += min(r, g, b) >= CLIPPED
            dark += max(r, g, b) < DARK
            magenta += min(r, b) > 60 and g * 3 < min(r, b) and abs(r - b) * 8 < max(r, b)
            night += max(r, g, b) < NIGHT
    shares = {
        name: round(n / max(solid, 1), 4)
        for name, n in (("clipped", clipped), ("magenta", magenta), ("dark", dark), ("night", night))
    }
    return {"covered": round(covered / 255 / (width * height), 4), "warmth": round(red / max(blue, 1), 2), **shares}


def render(job, output, *words):
    """(exit code or None for too long, what it said)."""
    command = [
        str(job["program"]),
        str(job["file"]),
        "-o",
        str(output),
        "--time",
        "0",
        "--scale",
        job["scale"],
        "--spp",
        str(job["spp"]),
        "--threads",
        "1",
        "--progress",
        "none",
        *words,
    ]
    try:
        done = subprocess.run(
            command, capture_output=True, text=True, errors="replace", timeout=SECONDS, stdin=subprocess.DEVNULL
        )
    except subprocess.TimeoutExpired:
        return None, ""
    return done.returncode, done.stderr


def look(job):
    """One file: the job with its pictures, figures and fault."""
    begin = time.monotonic()
    plain, grey = (job["folder"] / f"{job['place']:04}{kind}.png" for kind in ("", "_grey"))
    code, said = render(job, plain)
    missing = job["expected"].get("missing") or not pictures_of(job["file"])
    found = {
        "name": job["name"],
        "group": job["group"],
        "exit": code,
        "errors": len(re.findall(r"(?m)(^|: )error: ", said)),
        "said": said[-4000:],
    }
    expected, fault = job["expected"], ""
    if code is None:
        fault = "time"
    elif expected.get("nothing"):
        fault = "" if code == 3 else "exit"
        if not fault and "SCENE_EMPTY" not in said:
            fault = "silent"
    elif expected.get("refused"):
        fault = "exit" if code != 3 else "" if expected["refused"] in said else "silent"
    elif code != 0:
        fault = "exit"
    else:
        found.update(figures(pixels(plain)))
        grey_code, _ = render(job, grey, "--shader", f"*={HERE / 'grey.sl'}")
        under_grey = figures(pixels(grey)) if grey_code == 0 else {"dark": 1.0}
        found["dark"] = under_grey["dark"]
        fault = fault_of(found, missing, expected.get("small"))
        if not fault and found["covered"] < expected.get("least", 0):
            fault = "holes"
        if not fault and found["warmth"] < expected.get("warmth", 0):
            fault = "colour"
        if expected.get("told") and fault in ("", "black"):
            fault = "" if expected["told"] in said else "silent"
    found.update(
        fault=fault,
        seconds=round(time.monotonic() - begin, 2),
        plain=str(plain) if plain.exists() else None,
        grey=str(grey) if grey.exists() else None,
    )
    return found


def fault_of(found, missing, small):
    if found["covered"] < BLANK:
        return "blank"
    if found["covered"] < SPECK and not small:
        return "speck"
    if found["clipped"] > WHITE:
        return "white"
    if found["magenta"] > CHECKS and not missing:
        return "checks"
    return "black" if found["dark"] > BLACK or found["night"] > ALL_BLACK else ""


def pictures_of(file):
    """Whether a picture that the document names lies somewhere near it, whatever its folder and case."""
    if file.suffix.lower() != ".dae":
        return True
    text = file.read_text(encoding="utf-8", errors="replace")
    references = re.findall(r"<init_from>\s*(?:<ref>)?([^<]*\.\w+)\s*<", text)
    wanted = {re.split(r"[/\\\\:]", unquote(r).strip())[-1].lower() for r in references}
    around = (
        [file.parent, file.parent.parent]
        if file.parent.parent.name not in ("corpus", "scenes", "blind", "stranger")
        else [file.parent]
    )
    names = (name for folder in around for _, _, files in os.walk(folder) for name in files)
    return bool(wanted) and any(name.lower() in wanted for name in names)


def documents(folder):
    return sorted(
        f
        for f in folder.rglob("*")
        if f.suffix.lower() in (".dae", ".zae", ".kmz") and str(f.relative_to(folder)) not in NOT_SCENES
    )


def parts_of(options, scratch):
    """(group, name, file, expectations) of all files."""
    for part in options.parts:
        if part == "corpus":
            folder = scratch / "corpus"
            expected = corpus.write(folder)
        elif part == "stranger":
            folder = scratch / "stranger"
            expected = stranger.write(folder)
        elif part == "exporters":
            folder = scratch / "exporters"
            import exporters

            expected = exporters.write(folder)
        else:
            folder = {"blind": HERE / "blind", "shared": SHARED / "scenes"}.get(part, Path(part))
            said = folder / "corpus.json"
            expected = SHARED_EXPECTED if part == "shared" else json.loads(said.read_text()) if said.exists() else {}
        if not folder.is_dir():
            print(f"{part}: no folder {folder}, skipped")
            continue
        for file in documents(folder):
            name = str(file.relative_to(folder))
            group = name.split("/")[0] if part in WRITTEN else folder.name if os.sep in part else part
            if not options.only or any(fnmatch.fnmatch(f"{part}/{name}", g) for g in options.only):
                yield group, name if part in WRITTEN else f"{group}/{name}", file, expected.get(
                    name, {}
                )


def table(results):
    for r in results:
        shares = "  ".join(f"{k} {100 * r[k]:5.1f}%" for k in ("covered", "clipped", "magenta", "dark") if k in r)
        print(f"{r['fault'] or 'right':7} {r['name']:52} exit {r['exit']}  {shares}  {r['seconds']:.1f} s")
    groups = {}
    for r in results:
        groups.setdefault(r["group"], []).append(r)
    print(f"\n{'group':12} files right  " + " ".join(f"{k:>6}" for k in KINDS))
    for name, members in [*groups.items(), ("all", results)]:
        count = [sum(r["fault"] == k for r in members) for k in KINDS]
        print(
            f"{name:12} {len(members):5} {len(members) - sum(count):5}  " + " ".join(f"{n or '-':>6}" for n in count)
        )
    liars = sum(r["exit"] == 0 and r["errors"] > 0 for r in results)
    print(f'{liars} say "error:" and exit 0')


def changes(results, old):
    before = {r["name"]: r["fault"] for r in json.loads(old.read_text())}
    for r in results:
        if before.get(r["name"], r["fault"]) != r["fault"]:
            print(f"changed: {r['name']}: {before[r['name']] or 'right'} -> {r['fault'] or 'right'}")


def sheets(results, folder, cell):
    """Pages of at most 80 files: the picture by default and the one under the grey matte, on a mid grey."""
    pages = []
    for start in range(0, len(results), 80):
        shown = results[start : start + 80]
        wide, high = 2 * cell + 4, cell * 3 // 4 + STRIP
        lines = -(-len(shown) // COLUMNS)
        rows = [bytearray(bytes(PAPER) * (COLUMNS * wide)) for _ in range(lines * high)]
        for place, r in enumerate(shown):
            x, y = place % COLUMNS * wide, place // COLUMNS * high
            for k, name in enumerate(("plain", "grey")):
                if r[name]:
                    put(rows, pixels(Path(r[name])), x + k * cell, y, cell, cell * 3 // 4)
            text = f"{r['fault']}! {r['name']}" if r["fault"] else r["name"]
            lettering.draw(
                rows,
                text.lower()[-(wide // 6) :] if not r["fault"] else text.lower()[: wide // 6],
                x + 2,
                y + cell * 3 // 4 + 3,
                ALARM if r["fault"] else INK,
                wide - 4,
                1,
            )
        pages.append(folder / f"sheet-{len(pages) + 1}.png")
        png.write(pages[-1], COLUMNS * wide, len(rows), rows)
    print("sheets: " + ", ".join(map(str, pages)))


def put(rows, picture, x, y, wide, high):
    """The picture over mid grey, fitted into wide x high by nearest pixels."""
    width, height, data = picture
    scale = min(wide / width, high / height)
    w, h = int(width * scale), int(height * scale)
    for j in range(h):
        line, at = data[j * height // h], rows[y + j]
        for i in range(w):
            k = 4 * (i * width // w)
            a = line[k + 3]
            at[3 * (x + i) : 3 * (x + i) + 3] = bytes((c * a + 90 * (255 - a)) // 255 for c in line[k : k + 3])


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("parts", nargs="*")
    parser.add_argument("--out", type=Path)
    parser.add_argument("--against", type=Path)
    parser.add_argument("--scale", default="20%")
    parser.add_argument("--spp", type=int, default=4)
    parser.add_argument("--build", type=Path, default=ROOT / "build/release")
    parser.add_argument("--only", action="append", metavar="GLOB")
    parser.add_argument("--least", type=float, default=95)
    options = parser.parse_args()
    options.parts = options.parts or ["corpus", "blind", "stranger", "shared"]
    program = Path(os.environ.get("KINORA_BIN_DIR", options.build / "bin")) / "kinora-render"
    with tempfile.TemporaryDirectory(prefix="first_look_") as temporary:
        scratch = options.out or Path(temporary)
        pictures = scratch / "pictures"
        pictures.mkdir(parents=True, exist_ok=True)
        jobs = [
            {
                "place": k,
                "group": group,
                "name": name,
                "file": file,
                "expected": expected,
                "folder": pictures,
                "program": program,
                "scale": options.scale,
                "spp": options.spp,
            }
            for k, (group, name, file, expected) in enumerate(parts_of(options, scratch))
        ]
        if not jobs:
            sys.exit(77)
        with concurrent.futures.ProcessPoolExecutor(os.cpu_count()) as pool:
            results = list(pool.map(look, jobs))
        table(results)
        if options.against:
            changes(results, options.against)
        if options.out:
            (options.out / "first_look.json").write_text(json.dumps(results, indent=1) + "\n")
            sheets(results, options.out, 128)
    right = 100 * sum(not r["fault"] for r in results) / len(results)
    print(f"{right:.1f} % are right; at least {options.least:g} are wanted")
    sys.exit(right < options.least)


if __name__ == "__main__":
    main()
