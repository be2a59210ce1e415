"""scripts/sheet/apng.py: writes animated PNG files of 255 colors: what changes from frame to frame."""
import struct
import zlib

from . import png

CLEAR = 255  # the palette's last color: as the frame before


def key(r, g, b):
    """Five bits a channel."""
    return (r >> 3) << 10 | (g >> 3) << 5 | b >> 3


def counted(frames):
    counts = {}
    for rows in frames:
        for row in rows:
            for r, g, b in zip(row[0::3], row[1::3], row[2::3]):
                k = key(r, g, b)
                counts[k] = counts.get(k, 0) + 1
    return counts


def median_cut(counts, wanted):
    """Boxes of colors, each cut where half of its pixels lie (P. Heckbert, 1982)."""
    def spread(box):
        sides = [[k >> 10 for k, _ in box], [k >> 5 & 31 for k, _ in box], [k & 31 for k, _ in box]]
        wide = [max(side) - min(side) for side in sides]
        return max(wide), wide.index(max(wide))
    boxes = [list(counts.items())]
    while len(boxes) < wanted:
        # A wide box of many pixels first; the root keeps small bright things apart.
        value, index = max(((spread(box)[0] * sum(n for _, n in box) ** 0.4 if len(box) > 1 else -1), i)
                           for i, box in enumerate(boxes))
        if value < 0:
            break
        box = boxes.pop(index)
        axis = spread(box)[1]
        box.sort(key=lambda entry: entry[0] >> (10 - 5 * axis) & 31)
        half, seen, cut = sum(n for _, n in box) / 2, 0, 1
        for i, (_, n) in enumerate(box[:-1]):
            seen += n
            cut = i + 1
            if seen >= half:
                break
        boxes += [box[:cut], box[cut:]]
    palette, where = [], {}
    for number, box in enumerate(boxes):
        total = sum(n for _, n in box)
        palette.append(tuple(int(sum(((k >> shift & 31) * 255 / 31) * n for k, n in box) / total + 0.5) for shift in (10, 5, 0)))
        where.update((k, number) for k, _ in box)
    return palette, where


def indexed(rows, where):
    return [bytes(where[key(r, g, b)] for r, g, b in zip(row[0::3], row[1::3], row[2::3])) for row in rows]


def changed(before, now):
    """The box of what differs, (x, y, rows), with CLEAR where it does not; one pixel if nothing does."""
    lines = [y for y, (a, b) in enumerate(zip(before, now)) if a != b]
    if not lines:
        return 0, 0, [bytes([CLEAR])]
    columns = [x for x in range(len(now[0])) if any(before[y][x] != now[y][x] for y in lines)]
    x0, x1, y0, y1 = columns[0], columns[-1] + 1, lines[0], lines[-1] + 1
    return x0, y0, [bytes(n if n != b else CLEAR for b, n in zip(before[y][x0:x1], now[y][x0:x1])) for y in range(y0, y1)]


def write(path, frames, rate):
    """Frames are rows of RGB bytes, all of one size."""
    palette, where = median_cut(counted(frames), CLEAR)
    palette += [(0, 0, 0)] * (256 - len(palette))
    height, width, number = len(frames[0]), len(frames[0][0]) // 3, 0
    out = [png.SIGNATURE]

    def chunk(kind, body):
        out.append(struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body)))
    chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 3, 0, 0, 0))
    chunk(b"acTL", struct.pack(">II", len(frames), 0))
    chunk(b"PLTE", bytes(c for color in palette for c in color))
    chunk(b"tRNS", bytes([255] * CLEAR + [0]))
    before = None
    for rows in frames:
        now = indexed(rows, where)
        x, y, part = (0, 0, now) if before is None else changed(before, now)
        # dispose 0: stays; blend 1: over what is there.
        chunk(b"fcTL", struct.pack(">IIIIIHHBB", number, len(part[0]), len(part), x, y, 1, rate, 0, 0 if before is None else 1))
        number += 1
        body = zlib.compress(b"".join(b"\0" + row for row in part), 9)
        if before is None:
            chunk(b"IDAT", body)
        else:
            chunk(b"fdAT", struct.pack(">I", number) + body)
            number += 1
        before = now
    chunk(b"IEND", b"")
    with open(path, "wb") as file:
        file.write(b"".join(out))
