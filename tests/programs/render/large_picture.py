#!/usr/bin/env python3
"""tests/programs/render/large_picture.py: pictures larger than memory. scripts/nightly runs it.

    KINORA_BIN_DIR=... large_picture.py [SIDE]    # 32768

Renders a constant shader with one sample a pixel at SIDE x SIDE, to a PNG and an EXR. Each must stay under
2 GB of memory, and half the height must take as much. The PNG is read back row by row.
"""
import os
import struct
import sys
import zlib
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from programs import command  # noqa: E402
from written_scenes import CAMERA, EYE, document, geometries, place, rsl, square  # noqa: E402

MOST = 2 << 30  # bytes
WANTED = bytes([137, 188, 255, 255])  # .25 .5 1 in sRGB


def render(scene, out, width, height):
    """Peak memory of the run, bytes."""
    pid = os.spawnvp(os.P_NOWAIT, command("kinora-render")[0],
                     command("kinora-render", scene, "-o", out, "--size", f"{width}x{height}", "--spp", "1", "-q"))
    _, status, usage = os.wait4(pid, 0)
    if status:
        sys.exit(f"kinora-render ended with {status}")
    return usage.ru_maxrss * 1024


def chunks(file):
    file.seek(8)
    while True:
        length, kind = struct.unpack(">I4s", file.read(8))
        yield kind, file, length
        file.seek(4, os.SEEK_CUR)
        if kind == b"IEND":
            return


def check_png(path, width, height):
    """Each row has the color wanted; filters of rows are undone for None, Sub and Up, which constant rows have."""
    row, rows, unpack = 1 + 4 * width, 0, zlib.decompressobj()
    plain = {0: WANTED * width, 1: WANTED + bytes(4 * width - 4), 2: bytes(4 * width)}
    left = b""
    with open(path, "rb") as file:
        for kind, stream, length in chunks(file):
            data = stream.read(length)
            if kind == b"IHDR" and struct.unpack(">II", data[:8]) != (width, height):
                sys.exit(f"{path}: wrong size")
            if kind != b"IDAT":
                continue
            left += unpack.decompress(data)
            while len(left) >= row:
                body = left[1:row]
                if left[0] > 2 and rows == 0 or body != plain.get(left[0], bytes(4 * width)):
                    sys.exit(f"{path}: row {rows} is not of the color, filter {left[0]}: {body[:8].hex()}")
                left = left[row:]
                rows += 1
    if rows != height:
        sys.exit(f"{path}: {rows} rows of {height}")


def main():
    side = int(sys.argv[1]) if len(sys.argv) > 1 else 32768
    folder = Path(os.environ.get("TMPDIR", "/tmp")) / f"kinora_large_{os.getpid()}"
    folder.mkdir()
    scene = folder / "s.dae"
    scene.write_text(document(CAMERA + rsl("surface s() { Oi = 1; Ci = color(.25, .5, 1); }") +
                              geometries(square(half=1e6)), EYE + place()))
    try:
        for name in ("p.png", "p.exr"):
            out = folder / name
            half, whole = (render(scene, out, side, height) for height in (side // 2, side))
            print(f"{name}: {side} x {side // 2} {half / 1e6:.0f} MB, x {side} {whole / 1e6:.0f} MB of memory, "
                  f"{out.stat().st_size / 1e6:.1f} MB of file", flush=True)
            if whole > MOST or whole > 1.1 * half + (16 << 20):
                sys.exit("too much memory")
            if name.endswith(".png"):
                check_png(out, side, side)
            out.unlink()
    finally:
        for file in folder.iterdir():
            file.unlink()
        folder.rmdir()


if __name__ == "__main__":
    main()
