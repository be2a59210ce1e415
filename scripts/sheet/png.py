"""scripts/sheet/png.py: reads and writes 8-bit RGB(A) PNG files."""
import struct
import zlib

SIGNATURE = b"\x89PNG\r\n\x1a\n"


def chunks(data):
    at = len(SIGNATURE)
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at:at + 8])
        yield kind, data[at + 8:at + 8 + length]
        at += length + 12


def paeth(a, b, c):
    p = a + b - c
    pa, pb, pc = abs(p - a), abs(p - b), abs(p - c)
    return a if pa <= pb and pa <= pc else b if pb <= pc else c


def unfilter(kind, row, above, step):
    """PNG specification, chapter 9: each byte is a difference from its neighbours."""
    if kind == 1:
        for i in range(step, len(row)):
            row[i] = (row[i] + row[i - step]) & 255
    elif kind == 2:
        for i, up in enumerate(above):
            row[i] = (row[i] + up) & 255
    elif kind == 3:
        for i, up in enumerate(above):
            row[i] = (row[i] + (((row[i - step] if i >= step else 0) + up) >> 1)) & 255
    elif kind == 4:
        for i, up in enumerate(above):
            left, corner = (row[i - step], above[i - step]) if i >= step else (0, 0)
            row[i] = (row[i] + paeth(left, up, corner)) & 255
    return row


def read(path):
    """(width, height, rows of RGB bytes); what is transparent shows black."""
    with open(path, "rb") as file:
        parts = list(chunks(file.read()))
    width, height, depth, colour = struct.unpack(">IIBB", parts[0][1][:10])
    if depth != 8 or colour not in (2, 6):
        raise ValueError(f"{path}: only 8-bit RGB and RGBA are read")
    step = 3 if colour == 2 else 4
    data = zlib.decompress(b"".join(body for kind, body in parts if kind == b"IDAT"))
    rows, above = [], bytes(width * step)
    for y in range(height):
        at = y * (width * step + 1)
        above = unfilter(data[at], bytearray(data[at + 1:at + 1 + width * step]), above, step)
        rows.append(bytes(above) if step == 3 else over_black(above, width))
    return width, height, rows


def over_black(row, width):
    out = bytearray(3 * width)
    for channel in range(3):
        out[channel::3] = bytes(row[4 * i + channel] * row[4 * i + 3] // 255
                                for i in range(width))
    return bytes(out)


def write(path, width, height, rows):
    def chunk(kind, body):
        return (struct.pack(">I", len(body)) + kind + body
                + struct.pack(">I", zlib.crc32(kind + body)))

    header = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    body = zlib.compress(b"".join(b"\0" + bytes(row) for row in rows), 9)
    with open(path, "wb") as file:
        file.write(SIGNATURE + chunk(b"IHDR", header) + chunk(b"IDAT", body) + chunk(b"IEND", b""))
