# scripts/assets/split_concave.py: quads of a COLLADA text that are not convex (a modeller's quad may
# be so far from flat that its sides cross) become two triangles; all else stays byte for byte.
#
#   split_concave.py IN.dae OUT.dae
import re
import sys

POLYLIST = re.compile(r'(<polylist\b[^>]*\bcount=")(\d+)(".*?<vcount>)([^<]*)(</vcount>\s*<p>)([^<]*)(</p>)',
                      re.S)


def cross(a, b):
    return tuple(a[i - 2] * b[i - 1] - a[i - 1] * b[i - 2] for i in range(3))


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def minus(a, b):
    return tuple(x - y for x, y in zip(a, b))


def diagonal(quad):
    """None for a quad that is convex, seen along its normal and along the axis nearest to it; else
    the corner that the diagonal leaves from: the one that bends most to the other side."""
    normal = cross(minus(quad[2], quad[0]), minus(quad[3], quad[1]))
    near = max(range(3), key=lambda k: abs(normal[k]))
    axis = tuple(normal[k] if k == near else 0 for k in range(3))
    for view in (normal, axis):
        turns = [dot(view, cross(minus(quad[k], quad[k - 1]), minus(quad[(k + 1) % 4], quad[k])))
                 for k in range(4)]
        if min(turns) <= 0:
            return turns.index(min(turns))
    return None


def positions_of(text, polylist):
    vertices = re.search(r'semantic="VERTEX" source="#([^"]+)"', polylist).group(1)
    block = re.search(rf'<vertices id="{re.escape(vertices)}">(.*?)</vertices>', text, re.S).group(1)
    source = re.search(r'semantic="POSITION" source="#([^"]+)"', block).group(1)
    numbers = re.search(rf'<source id="{re.escape(source)}"[^>]*>\s*<float_array[^>]*>([^<]*)<', text)
    values = list(map(float, numbers.group(1).split()))
    return list(zip(values[0::3], values[1::3], values[2::3]))


def split_concave(text):
    def repaired(match):
        points = positions_of(text, match.group(0))
        stride = 1 + max(map(int, re.findall(r'offset="(\d+)"', match.group(3))))
        offset = int(re.search(r'semantic="VERTEX"[^>]*offset="(\d+)"', match.group(3)).group(1))
        counts, indices, at = [], [], 0
        numbers = match.group(6).split()
        for count in map(int, match.group(4).split()):
            corners = [numbers[at + stride * k:at + stride * (k + 1)] for k in range(count)]
            at += stride * count
            k = diagonal([points[int(c[offset])] for c in corners]) if count == 4 else None
            for part in (range(count),) if k is None else ((k, k + 1, k + 2), (k, k + 2, k + 3)):
                counts.append(len(part))
                indices += [n for corner in part for n in corners[corner % count]]
        if len(counts) == int(match.group(2)):
            return match.group(0)
        return (match.group(1) + str(len(counts)) + match.group(3) + " ".join(map(str, counts)) +
                match.group(5) + " ".join(indices) + match.group(7))
    return POLYLIST.sub(repaired, text)


if __name__ == "__main__":
    with open(sys.argv[1]) as file:
        before = file.read()
    with open(sys.argv[2], "w") as file:
        file.write(split_concave(before))
