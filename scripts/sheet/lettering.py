"""scripts/sheet/lettering.py: small letters, five dots by seven, for the names on a sheet."""

# Seven rows a letter, top first; the dots of a row are the bits of a number, left = 16.
LETTERS = {
    "a": (0, 0, 14, 1, 15, 17, 15), "b": (16, 16, 30, 17, 17, 17, 30),
    "c": (0, 0, 14, 16, 16, 17, 14), "d": (1, 1, 15, 17, 17, 17, 15),
    "e": (0, 0, 14, 17, 31, 16, 14), "f": (6, 9, 8, 28, 8, 8, 8),
    "g": (0, 15, 17, 17, 15, 1, 14), "h": (16, 16, 22, 25, 17, 17, 17),
    "i": (4, 0, 12, 4, 4, 4, 14), "j": (2, 0, 6, 2, 2, 18, 12),
    "k": (16, 16, 18, 20, 24, 20, 18), "l": (12, 4, 4, 4, 4, 4, 14),
    "m": (0, 0, 26, 21, 21, 17, 17), "n": (0, 0, 22, 25, 17, 17, 17),
    "o": (0, 0, 14, 17, 17, 17, 14), "p": (0, 0, 30, 17, 30, 16, 16),
    "q": (0, 0, 15, 17, 15, 1, 1), "r": (0, 0, 22, 25, 16, 16, 16),
    "s": (0, 0, 15, 16, 14, 1, 30), "t": (8, 8, 28, 8, 8, 9, 6),
    "u": (0, 0, 17, 17, 17, 19, 13), "v": (0, 0, 17, 17, 17, 10, 4),
    "w": (0, 0, 17, 17, 21, 21, 10), "x": (0, 0, 17, 10, 4, 10, 17),
    "y": (0, 0, 17, 17, 15, 1, 14), "z": (0, 0, 31, 2, 4, 8, 31),
    "0": (14, 17, 19, 21, 25, 17, 14), "1": (4, 12, 4, 4, 4, 4, 14),
    "2": (14, 17, 1, 6, 8, 16, 31), "3": (31, 2, 4, 2, 1, 17, 14),
    "4": (2, 6, 10, 18, 31, 2, 2), "5": (31, 16, 30, 1, 1, 17, 14),
    "6": (6, 8, 16, 30, 17, 17, 14), "7": (31, 1, 2, 4, 8, 8, 8),
    "8": (14, 17, 17, 14, 17, 17, 14), "9": (14, 17, 17, 15, 1, 2, 12),
    "_": (0, 0, 0, 0, 0, 0, 31), "/": (1, 1, 2, 4, 8, 16, 16), "-": (0, 0, 0, 31, 0, 0, 0),
    "!": (4, 4, 4, 4, 4, 0, 4), " ": (0,) * 7,
}
ADVANCE, HEIGHT = 6, 7


def draw(rows, text, x, y, colour, room, scale=2):
    """Onto rows (bytearrays of RGB); what is longer than `room` pixels is drawn smaller."""
    if len(text) * ADVANCE * scale > room:
        scale = 1
    dot = bytes(colour) * scale
    for place, letter in enumerate(text):
        left = x + place * ADVANCE * scale
        for j, bits in enumerate(LETTERS.get(letter, LETTERS["-"])):
            for i in range(5):
                at = 3 * (left + i * scale)
                if bits >> (4 - i) & 1 and at + len(dot) <= len(rows[0]):
                    for k in range(scale):
                        rows[y + j * scale + k][at:at + len(dot)] = dot
