"""Low-poly models for the documents of tests/first_look: furniture, robots, vehicles, people, buildings, land.

Every model is a Mesh in metres with z up and its front towards -y, as the modellers that wrote the originals have it; dae.py turns it
into the units and axes of an exporter. All numbers come from arithmetic and one seeded generator, so a corpus is the same everywhere.
"""
import math
import random
import struct
import zlib


class Mesh:
    """Points and faces; a face is (point indices, material, uv of each corner)."""

    def __init__(self):
        self.points = []
        self.faces = []

    def add(self, points, faces, material, uvs=None):
        base = len(self.points)
        if inside_out(points, faces):
            faces = [tuple(reversed(f)) for f in faces]
            uvs = uvs and [list(reversed(uv)) for uv in uvs]
        self.points += [tuple(map(float, p)) for p in points]
        for i, face in enumerate(faces):
            uv = uvs[i] if uvs else [box_uv(points, face, k) for k in range(len(face))]
            self.faces.append((tuple(base + k for k in face), material, tuple(uv)))
        return self

    def join(self, other):
        base = len(self.points)
        self.points += other.points
        self.faces += [(tuple(base + k for k in f), m, uv) for f, m, uv in other.faces]
        return self

    def moved(self, x=0, y=0, z=0, turn=0, scale=1):
        """A copy: scaled, turned about z by degrees, moved."""
        c, s = math.cos(math.radians(turn)), math.sin(math.radians(turn))
        out = Mesh()
        out.points = [
            (x + scale * (c * p[0] - s * p[1]), y + scale * (s * p[0] + c * p[1]), z + scale * p[2])
            for p in self.points
        ]
        out.faces = list(self.faces)
        return out

    def named(self, materials):
        """A copy with materials renamed by a dictionary (or all to one name)."""
        out = Mesh()
        out.points = list(self.points)
        out.faces = [
            (f, materials if isinstance(materials, str) else materials.get(m, m), uv) for f, m, uv in self.faces
        ]
        return out

    def materials(self):
        seen = []
        for _, m, _ in self.faces:
            if m not in seen:
                seen.append(m)
        return seen

    def bounds(self):
        return [min(p[i] for p in self.points) for i in range(3)], [max(p[i] for p in self.points) for i in range(3)]

    def split(self):
        """One mesh a material, with only the points it uses."""
        out = {}
        for name in self.materials():
            m, index = Mesh(), {}
            for f, mat, uv in self.faces:
                if mat == name:
                    for k in f:
                        if k not in index:
                            index[k] = len(m.points)
                            m.points.append(self.points[k])
                    m.faces.append((tuple(index[k] for k in f), mat, uv))
            out[name] = m
        return out

    def face_normal(self, face):
        n = [0.0, 0.0, 0.0]
        for a, b in zip(face, face[1:] + face[:1]):
            p, q = self.points[a], self.points[b]
            n[0] += (p[1] - q[1]) * (p[2] + q[2])
            n[1] += (p[2] - q[2]) * (p[0] + q[0])
            n[2] += (p[0] - q[0]) * (p[1] + q[1])
        return tuple(n)

    def smooth_normals(self):
        """A normal a point: the sum of its faces' area normals."""
        sums = [[0.0, 0.0, 0.0] for _ in self.points]
        for f, _, _ in self.faces:
            n = self.face_normal(f)
            for k in f:
                for i in range(3):
                    sums[k][i] += n[i]
        return [unit(n) for n in sums]


def inside_out(points, faces):
    """Whether a closed surface's faces look inwards (its signed volume is negative)."""
    edges = {(f[k], f[(k + 1) % len(f)]) for f in faces for k in range(len(f))}
    if any((b, a) not in edges for a, b in edges):
        return False
    volume = 0.0
    for f in faces:
        a = points[f[0]]
        for i in range(1, len(f) - 1):
            b, c = points[f[i]], points[f[i + 1]]
            volume += (
                a[0] * (b[1] * c[2] - b[2] * c[1])
                - a[1] * (b[0] * c[2] - b[2] * c[0])
                + a[2] * (b[0] * c[1] - b[1] * c[0])
            )
    return volume < 0


def unit(v):
    length = math.sqrt(sum(c * c for c in v))
    return tuple(c / length for c in v) if length > 0 else (0.0, 0.0, 1.0)


def box_uv(points, face, k):
    """Planar mapping along the axis the face looks at most, one tile a metre."""
    m = Mesh()
    m.points = points
    n = m.face_normal(tuple(face))
    axis = max(range(3), key=lambda i: abs(n[i]))
    p = points[face[k]]
    u, v = [(p[1], p[2]), (p[0], p[2]), (p[0], p[1])][axis]
    return (u, v)


def box(x0, y0, z0, x1, y1, z1, material):
    p = [(x, y, z) for z in (z0, z1) for y in (y0, y1) for x in (x0, x1)]
    f = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
    return Mesh().add(p, f, material)


def block(cx, cy, cz, sx, sy, sz, material):
    return box(cx - sx / 2, cy - sy / 2, cz - sz / 2, cx + sx / 2, cy + sy / 2, cz + sz / 2, material)


def frame_of(a, b):
    w = unit([b[i] - a[i] for i in range(3)])
    h = (1.0, 0.0, 0.0) if abs(w[0]) < 0.8 else (0.0, 1.0, 0.0)
    u = unit((w[1] * h[2] - w[2] * h[1], w[2] * h[0] - w[0] * h[2], w[0] * h[1] - w[1] * h[0]))
    v = (w[1] * u[2] - w[2] * u[1], w[2] * u[0] - w[0] * u[2], w[0] * u[1] - w[1] * u[0])
    return u, v


def tube(path, radii, sides, material, caps=True, squash=1.0):
    """A round loft along a path of points with a radius at each; squash flattens its second axis."""
    points, faces, uvs = [], [], []
    u, v = frame_of(path[0], path[-1])
    for p, r in zip(path, radii):
        for k in range(sides):
            t = 2 * math.pi * k / sides
            points.append(tuple(p[i] + r * (math.cos(t) * u[i] + squash * math.sin(t) * v[i]) for i in range(3)))
    rings = len(path)
    for j in range(rings - 1):
        for k in range(sides):
            n = (k + 1) % sides
            faces.append((j * sides + k, j * sides + n, (j + 1) * sides + n, (j + 1) * sides + k))
            a, b, s, t = k / sides, (k + 1) / sides, j / (rings - 1), (j + 1) / (rings - 1)
            uvs.append([(a, s), (b, s), (b, t), (a, t)])
    if caps:
        faces.append(tuple(range(sides - 1, -1, -1)))
        faces.append(tuple(range((rings - 1) * sides, rings * sides)))
        for f in faces[-2:]:
            uvs.append(
                [
                    (0.5 + 0.5 * math.cos(2 * math.pi * k / sides), 0.5 + 0.5 * math.sin(2 * math.pi * k / sides))
                    for k in range(len(f))
                ]
            )
    return Mesh().add(points, faces, material, uvs)


def cylinder(a, b, r, sides, material, r2=None):
    return tube([a, b], [r, r if r2 is None else r2], sides, material)


def ball(cx, cy, cz, rx, ry, rz, sides, rings, material):
    points, faces, uvs = [(cx, cy, cz - rz)], [], []
    for j in range(1, rings):
        t = math.pi * j / rings
        for k in range(sides):
            a = 2 * math.pi * k / sides
            points.append(
                (cx + rx * math.sin(t) * math.cos(a), cy + ry * math.sin(t) * math.sin(a), cz - rz * math.cos(t))
            )
    points.append((cx, cy, cz + rz))
    top = len(points) - 1
    for k in range(sides):
        n = (k + 1) % sides
        faces.append((0, 1 + n, 1 + k))
        uvs.append([(k / sides, 0), ((k + 1) / sides, 1 / rings), (k / sides, 1 / rings)])
        for j in range(rings - 2):
            a, b = 1 + j * sides, 1 + (j + 1) * sides
            faces.append((a + k, a + n, b + n, b + k))
            s, t = (j + 1) / rings, (j + 2) / rings
            uvs.append([(k / sides, s), ((k + 1) / sides, s), ((k + 1) / sides, t), (k / sides, t)])
        a = 1 + (rings - 2) * sides
        faces.append((a + k, a + n, top))
        uvs.append([(k / sides, 1 - 1 / rings), ((k + 1) / sides, 1 - 1 / rings), (k / sides, 1)])
    return Mesh().add(points, faces, material, uvs)


def prism(outline, a, b, axis, material):
    """A closed outline (counter-clockwise seen against the axis) swept from a to b along x, y or z."""

    def place(p, h):
        return [(h, p[0], p[1]), (p[1], h, p[0]), (p[0], p[1], h)][axis]

    n = len(outline)
    points = [place(p, a) for p in outline] + [place(p, b) for p in outline]
    faces = [tuple(range(n - 1, -1, -1)), tuple(range(n, 2 * n))]
    faces += [(k, (k + 1) % n, n + (k + 1) % n, n + k) for k in range(n)]
    return Mesh().add(points, faces, material)


def lathe(profile, sides, material):
    """A profile of (radius, height) turned about z."""
    return tube([(0, 0, h) for _, h in profile], [r for r, _ in profile], sides, material, caps=True)


def land(size, cells, height, material, tiles=1.0):
    points, faces, uvs = [], [], []
    for j in range(cells + 1):
        for i in range(cells + 1):
            x, y = size * (i / cells - 0.5), size * (j / cells - 0.5)
            points.append((x, y, height(x, y)))
    for j in range(cells):
        for i in range(cells):
            a = j * (cells + 1) + i
            faces.append((a, a + 1, a + cells + 2, a + cells + 1))
            uvs.append(
                [(tiles * (i + du) / cells, tiles * (j + dv) / cells) for du, dv in ((0, 0), (1, 0), (1, 1), (0, 1))]
            )
    return Mesh().add(points, faces, material, uvs)


def hills(x, y):
    return 6 * math.sin(x * 0.11) * math.cos(y * 0.13) + 2.5 * math.sin(x * 0.37 + 1) * math.sin(y * 0.31) + 0.02 * x


# models -----------------------------------------------------------------------------------------------------------------------------


def chair():
    m = block(0, 0, 0.45, 0.46, 0.44, 0.05, "wood")
    for x in (-0.2, 0.2):
        m.join(cylinder((x, -0.19, 0), (x, -0.19, 0.43), 0.022, 8, "wood"))
        m.join(cylinder((x, 0.19, 0), (x, 0.21, 0.95), 0.022, 8, "wood"))
    for z in (0.6, 0.72, 0.84):
        m.join(block(0, 0.205, z, 0.4, 0.02, 0.07, "cloth"))
    return m


def table(round_top=False):
    if round_top:
        m = cylinder((0, 0, 0.72), (0, 0, 0.76), 0.45, 24, "wood")
        m.join(cylinder((0, 0, 0.04), (0, 0, 0.72), 0.04, 10, "metal")).join(
            cylinder((0, 0, 0), (0, 0, 0.04), 0.28, 20, "metal")
        )
        return m
    m = block(0, 0, 0.74, 1.6, 0.8, 0.04, "wood")
    for x in (-0.74, 0.74):
        for y in (-0.34, 0.34):
            m.join(block(x, y, 0.36, 0.06, 0.06, 0.72, "metal"))
    return m


def shelf():
    m = (
        block(-0.49, 0, 0.9, 0.02, 0.3, 1.8, "wood")
        .join(block(0.49, 0, 0.9, 0.02, 0.3, 1.8, "wood"))
        .join(block(0, 0.14, 0.9, 0.96, 0.02, 1.8, "wood"))
    )
    rng = random.Random(4)
    for s in range(5):
        z = 0.05 + 0.42 * s
        m.join(block(0, 0, z, 0.96, 0.28, 0.02, "wood"))
        x = -0.46
        while x < 0.4 and s < 4:
            w, h = rng.uniform(0.02, 0.06), rng.uniform(0.2, 0.34)
            m.join(box(x, -0.12, z + 0.01, x + w, 0.08, z + 0.01 + h, rng.choice(["red", "green", "cloth"])))
            x += w + 0.005
    return m


def sofa():
    m = block(0, 0, 0.25, 1.9, 0.8, 0.3, "cloth").join(block(0, 0.34, 0.6, 1.9, 0.16, 0.5, "cloth"))
    for x in (-0.9, 0.9):
        m.join(block(x, 0, 0.45, 0.18, 0.85, 0.5, "cloth"))
    for x in (-0.42, 0.42):
        m.join(ball(x, -0.02, 0.42, 0.42, 0.38, 0.1, 12, 6, "red"))
    for x in (-0.85, 0.85):
        for y in (-0.33, 0.33):
            m.join(cylinder((x, y, 0), (x, y, 0.1), 0.03, 8, "wood"))
    return m


def desk_lamp():
    m = cylinder((0, 0, 0), (0, 0, 0.03), 0.1, 16, "metal").join(
        tube([(0, 0, 0.03), (0.06, 0, 0.25), (0.02, 0, 0.45)], [0.012] * 3, 8, "metal")
    )
    m.join(tube([(0.02, 0, 0.42), (-0.12, 0, 0.36)], [0.04, 0.09], 16, "red", caps=False)).join(
        ball(-0.09, 0, 0.37, 0.03, 0.03, 0.03, 8, 6, "glow")
    )
    return m


def house():
    m = block(0, 0, 1.5, 8, 6, 3, "wall")
    m.join(prism([(-3.4, 3), (3.4, 3), (0, 5.2)], -4.3, 4.3, 0, "roof"))
    m.join(block(0, -3.03, 1.05, 1.0, 0.1, 2.1, "wood"))
    for x in (-2.6, 2.6):
        m.join(block(x, -3.03, 1.7, 1.2, 0.08, 1.0, "glass"))
    m.join(block(2.4, 1, 5, 0.6, 0.6, 2, "wall"))
    m.join(box(-12, -10, -0.05, 12, 10, 0, "grass"))
    return m


def tower(floors=9):
    m = Mesh()
    for k in range(floors):
        m.join(block(0, 0, 1.5 + 3 * k, 12, 9, 2.9, "wall"))
        for x in range(-5, 6, 2):
            for y, d in ((-4.53, 1), (4.53, 1)):
                m.join(block(x, y, 1.6 + 3 * k, 1.2, 0.06, 1.6, "glass"))
    m.join(block(0, 0, 3 * floors + 0.4, 12.6, 9.6, 0.8, "metal")).join(
        block(2, 1, 3 * floors + 2, 3, 3, 2.6, "wall")
    )
    return m


def city(seed=7, n=5):
    rng, m = random.Random(seed), Mesh()
    for i in range(n):
        for j in range(n):
            x, y, w, d, h = 30 * i, 30 * j, rng.uniform(10, 20), rng.uniform(10, 20), rng.uniform(8, 45)
            m.join(block(x, y, h / 2, w, d, h, "wall"))
            if rng.random() < 0.5:
                m.join(prism([(y - d / 2, h), (y + d / 2, h), (y, h + d / 3)], x - w / 2, x + w / 2, 0, "roof"))
    m.join(box(-20, -20, -0.5, 30 * n - 10, 30 * n - 10, 0, "grass"))
    return m


def car():
    side = [
        (-2.1, 0.35),
        (2.1, 0.35),
        (2.15, 0.75),
        (1.3, 0.9),
        (0.7, 1.4),
        (-1.0, 1.45),
        (-1.7, 0.95),
        (-2.15, 0.85),
    ]
    m = prism(side, -0.85, 0.85, 0, "paint")
    m.join(prism([(0.75, 1.36), (1.28, 0.93), (1.3, 0.96), (0.77, 1.39)], -0.7, 0.7, 0, "glass"))
    for x in (-0.86, 0.86):
        m.join(block(x, -0.2, 1.15, 0.02, 1.3, 0.35, "glass"))
        for y in (-1.35, 1.35):
            s = 0.12 if x > 0 else -0.12
            m.join(cylinder((x - s, y, 0.34), (x + s * 0.3, y, 0.34), 0.34, 16, "rubber")).join(
                cylinder((x, y, 0.34), (x + s * 0.4, y, 0.34), 0.18, 12, "metal")
            )
    for x in (-0.6, 0.6):
        m.join(ball(x, 2.13, 0.62, 0.14, 0.06, 0.1, 10, 6, "glow")).join(block(x, -2.15, 0.7, 0.3, 0.05, 0.14, "red"))
    return m


def truck():
    m = (
        block(0, 0.6, 1.9, 2.3, 5.4, 2.4, "cloth")
        .join(block(0, -3.2, 1.6, 2.2, 1.8, 2.0, "paint"))
        .join(block(0, -4.12, 2.0, 1.9, 0.06, 0.8, "glass"))
    )
    m.join(block(0, -0.4, 0.65, 0.9, 7.2, 0.25, "metal"))
    for y in (-3.2, 1.2, 2.4):
        for x in (-0.95, 0.95):
            m.join(cylinder((x - 0.15, y, 0.5), (x + 0.15, y, 0.5), 0.5, 14, "rubber"))
    return m


def plane():
    m = tube(
        [(0, -4, 0), (0, -3.4, 0.05), (0, -1.5, 0.1), (0, 1.5, 0.15), (0, 4, 0.5)],
        [0.08, 0.5, 0.7, 0.6, 0.12],
        12,
        "paint",
    )
    m.join(
        prism([(-5.2, -0.2), (-5.2, 0.5), (0, 1.0), (5.2, 0.5), (5.2, -0.2), (0, -1.2)][::-1], 0.0, 0.12, 2, "paint")
    )
    m.join(prism([(-1.8, 3.4), (-1.8, 3.9), (1.8, 3.9), (1.8, 3.4), (0, 3.0)][::-1], 0.5, 0.56, 2, "red"))
    m.join(block(0, 3.6, 1.1, 0.08, 0.8, 1.2, "red")).join(ball(0, -1.2, 0.7, 0.4, 0.9, 0.4, 10, 6, "glass"))
    m.join(block(0, -4.1, 0, 2.2, 0.05, 0.16, "wood")).join(ball(0, -4.15, 0, 0.15, 0.2, 0.15, 8, 5, "metal"))
    return m


def ship():
    hull = [(-1.2, 0), (-1.6, 1.4), (1.6, 1.4), (1.2, 0)]
    m, pts, faces = Mesh(), [], []
    stations = [(-6, 0.05), (-4, 0.7), (-1, 1), (3, 1), (5.5, 0.75)]
    for y, s in stations:
        pts += [(x * s, y, z) for x, z in hull]
    for j in range(len(stations) - 1):
        faces += [(4 * j + k, 4 * j + (k + 1) % 4, 4 * j + 4 + (k + 1) % 4, 4 * j + 4 + k) for k in range(4)]
    faces += [(3, 2, 1, 0), tuple(range(16, 20))]
    m.add(pts, faces, "paint")
    m.join(block(0, 2, 2.1, 2, 3, 1.4, "wall")).join(block(0, 1.6, 3.2, 1.6, 1.6, 0.9, "wall")).join(
        cylinder((0, 3, 2.6), (0, 3.3, 4.4), 0.35, 12, "red")
    )
    return m.join(cylinder((0, -3, 1.4), (0, -3, 5), 0.08, 8, "wood"))


def person(arms=0.15):
    m = tube(
        [(0, 0, 0.92), (0, 0, 1.1), (0, 0, 1.32), (0, 0, 1.48)], [0.16, 0.14, 0.2, 0.1], 12, "cloth", squash=0.65
    )
    m.join(ball(0, -0.01, 1.66, 0.1, 0.11, 0.14, 12, 8, "skin")).join(
        cylinder((0, 0, 1.46), (0, 0, 1.56), 0.055, 8, "skin")
    )
    m.join(ball(0, 0.02, 1.72, 0.11, 0.115, 0.1, 10, 6, "hair"))
    for s in (-1, 1):
        m.join(
            tube(
                [(s * 0.09, 0, 0.95), (s * 0.1, -0.01, 0.5), (s * 0.1, 0, 0.08)], [0.095, 0.07, 0.045], 10, "trousers"
            )
        )
        m.join(block(s * 0.1, -0.06, 0.04, 0.09, 0.26, 0.08, "shoes"))
        hx = s * (0.22 + 0.6 * math.sin(arms))
        hz = 1.42 - 0.6 * math.cos(arms)
        m.join(
            tube(
                [(s * 0.2, 0, 1.42), ((s * 0.2 + hx) / 2, 0.01, (1.42 + hz) / 2), (hx, -0.02, hz)],
                [0.06, 0.048, 0.035],
                8,
                "cloth",
            )
        )
        m.join(ball(hx, -0.03, hz - 0.05, 0.04, 0.03, 0.07, 8, 5, "skin"))
    return m


def dog():
    m = tube([(0, -0.45, 0.5), (0, -0.2, 0.48), (0, 0.3, 0.46), (0, 0.45, 0.5)], [0.1, 0.17, 0.13, 0.06], 10, "fur")
    m.join(ball(0, -0.58, 0.66, 0.1, 0.14, 0.11, 10, 7, "fur")).join(
        ball(0, -0.72, 0.62, 0.05, 0.08, 0.05, 8, 5, "hair")
    )
    m.join(tube([(0, 0.44, 0.5), (0, 0.6, 0.68)], [0.04, 0.015], 6, "fur"))
    for x in (-0.09, 0.09):
        m.join(block(x * 0.8, -0.55, 0.78, 0.05, 0.03, 0.09, "hair"))
        for y in (-0.25, 0.3):
            m.join(tube([(x, y, 0.45), (x, y + 0.03, 0.22), (x, y, 0)], [0.06, 0.035, 0.035], 8, "fur"))
    return m


def arm_link(length=0.4, r=0.06):
    m = cylinder((0, -r * 1.3, 0), (0, r * 1.3, 0), r * 1.25, 16, "metal").join(
        tube([(0, 0, 0), (0, 0, length * 0.5), (0, 0, length)], [r * 0.9, r * 0.7, r * 0.8], 14, "paint")
    )
    return m.join(cylinder((0, -r, length), (0, r, length), r, 16, "metal"))


def robot_arm():
    m = cylinder((0, 0, 0), (0, 0, 0.12), 0.16, 20, "rubber").join(
        cylinder((0, 0, 0.12), (0, 0, 0.3), 0.1, 16, "paint")
    )
    m.join(tube([(0, 0, 0.35), (0.16, 0, 0.75)], [0.07, 0.055], 14, "paint")).join(
        cylinder((0.16, -0.09, 0.75), (0.16, 0.09, 0.75), 0.075, 16, "metal")
    )
    m.join(tube([(0.16, 0, 0.75), (0.55, 0, 0.85)], [0.055, 0.045], 14, "paint")).join(
        ball(0, 0, 0.34, 0.11, 0.11, 0.09, 14, 8, "metal")
    )
    m.join(cylinder((0.55, 0, 0.85), (0.66, 0, 0.8), 0.04, 12, "metal"))
    for y in (-0.035, 0.035):
        m.join(block(0.71, y, 0.78, 0.11, 0.015, 0.03, "rubber"))
    return m


def rover():
    m = (
        block(0, 0, 0.28, 0.44, 0.66, 0.2, "paint")
        .join(block(0, 0, 0.4, 0.46, 0.5, 0.03, "metal"))
        .join(cylinder((0, -0.18, 0.41), (0, -0.18, 0.52), 0.05, 16, "rubber"))
    )
    m.join(cylinder((0.15, 0.2, 0.4), (0.15, 0.2, 0.75), 0.01, 6, "metal")).join(
        block(0, -0.36, 0.27, 0.4, 0.07, 0.08, "rubber")
    )
    for x in (-0.27, 0.27):
        for y in (-0.22, 0.22):
            m.join(cylinder((x - 0.05, y, 0.16), (x + 0.05, y, 0.16), 0.16, 16, "rubber")).join(
                cylinder((x - 0.055, y, 0.16), (x + 0.055, y, 0.16), 0.08, 10, "metal")
            )
    return m


def quadrotor():
    m = block(0, 0, 0, 0.18, 0.18, 0.06, "paint").join(ball(0, -0.08, -0.04, 0.04, 0.04, 0.04, 10, 6, "rubber"))
    for a in range(4):
        t = math.pi / 4 + a * math.pi / 2
        x, y = 0.3 * math.cos(t), 0.3 * math.sin(t)
        m.join(cylinder((0, 0, 0), (x, y, 0.01), 0.014, 8, "metal")).join(
            cylinder((x, y, -0.01), (x, y, 0.05), 0.028, 10, "rubber")
        )
        m.join(block(x, y, 0.055, 0.24, 0.02, 0.004, "red"))
        m.join(
            cylinder(
                (0.07 * math.cos(t), 0.07 * math.sin(t), -0.02),
                (0.13 * math.cos(t), 0.13 * math.sin(t), -0.16),
                0.008,
                6,
                "metal",
            )
        )
    return m


def gear(teeth=16):
    outline = []
    for k in range(teeth):
        for d, r in ((0, 0.8), (0.25, 1.0), (0.5, 1.0), (0.75, 0.8)):
            a = 2 * math.pi * (k + d) / teeth
            outline.append((r * math.cos(a), r * math.sin(a)))
    return prism(outline, 0, 0.3, 2, "metal").join(cylinder((0, 0, 0.3), (0, 0, 0.5), 0.35, 20, "metal"))


def bolt():
    hexagon = [(0.9 * math.cos(k * math.pi / 3), 0.9 * math.sin(k * math.pi / 3)) for k in range(6)]
    m = prism(hexagon, 3, 3.7, 2, "metal").join(cylinder((0, 0, 0), (0, 0, 3), 0.48, 16, "metal"))
    for k in range(9):
        m.join(
            tube(
                [(0, 0, 0.1 + 0.25 * k), (0, 0, 0.2 + 0.25 * k), (0, 0, 0.3 + 0.25 * k)],
                [0.48, 0.56, 0.48],
                16,
                "metal",
                caps=False,
            )
        )
    return m


def barrel():
    return lathe(
        [
            (0.28, 0),
            (0.29, 0.02),
            (0.29, 0.28),
            (0.305, 0.3),
            (0.29, 0.32),
            (0.29, 0.58),
            (0.305, 0.6),
            (0.29, 0.62),
            (0.29, 0.88),
            (0.28, 0.9),
        ],
        18,
        "paint",
    )


def bottle():
    return lathe(
        [(0.035, 0), (0.038, 0.01), (0.038, 0.16), (0.03, 0.2), (0.013, 0.24), (0.013, 0.3), (0.015, 0.31)],
        16,
        "glass",
    )


def mug():
    m = lathe([(0.038, 0), (0.04, 0.01), (0.042, 0.095), (0.037, 0.095), (0.034, 0.015)], 18, "paint")
    arc = [(0.04 + 0.028 * math.sin(t), 0, 0.05 - 0.03 * math.cos(t)) for t in [k * math.pi / 6 for k in range(7)]]
    return m.join(tube(arc, [0.006] * 7, 6, "paint"))


def crate():
    m = block(0, 0, 0.5, 0.96, 0.96, 0.96, "wood")
    for x in (-0.47, 0.47):
        for y in (-0.47, 0.47):
            m.join(block(x, y, 0.5, 0.08, 0.08, 1.0, "metal"))
    for z in (0.03, 0.97):
        for s in (-0.47, 0.47):
            m.join(block(0, s, z, 0.9, 0.07, 0.07, "metal")).join(block(s, 0, z, 0.07, 0.9, 0.07, "metal"))
    return m


def cone():
    m = block(0, 0, 0.015, 0.36, 0.36, 0.03, "rubber")

    def r(z):
        return 0.13 - 0.155 * z

    for z0, z1, mat in ((0.03, 0.3, "red"), (0.3, 0.45, "wall"), (0.45, 0.68, "red")):
        m.join(cylinder((0, 0, z0), (0, 0, z1), r(z0), 16, mat, r(z1)))
    return m


def bridge():
    m = block(0, 0, 5, 40, 6, 0.6, "metal")
    for y in (-2.8, 2.8):
        prev = None
        for k in range(11):
            x = -20 + 4 * k
            top = (x, y, 5.3 + 4.5 * (1 - ((x / 20) ** 2)))
            m.join(cylinder((x, y, 5.3), (x, y, top[2] + 0.2), 0.15, 6, "red"))
            if prev:
                m.join(cylinder(prev, top, 0.2, 6, "red"))
            prev = top
    for x in (-14, 14):
        m.join(block(x, 0, 2.35, 1.6, 5, 4.7, "wall"))
    return m


def stairs():
    m = Mesh()
    for k in range(12):
        m.join(block(0, 0.28 * k, 0.17 * (k + 0.5), 1.2, 0.28, 0.17, "wall"))
        m.join(cylinder((0.58, 0.28 * k, 0.17 * (k + 1)), (0.58, 0.28 * k, 0.17 * (k + 1) + 0.9), 0.012, 6, "metal"))
    return m.join(cylinder((0.58, 0, 1.07), (0.58, 0.28 * 11, 1.07 + 0.17 * 11), 0.025, 8, "wood"))


def warehouse():
    """Walls, floor and roof beams that face inwards and outwards: a room to stand in."""
    m = box(-10, -15, -0.1, 10, 15, 0, "floor")
    for s in (-1, 1):
        m.join(box(s * 10 - 0.1, -15, 0, s * 10 + 0.1, 15, 6, "wall")).join(
            box(-10, s * 15 - 0.1, 0, 10, s * 15 + 0.1, 6, "wall")
        )
    for k in range(6):
        m.join(block(0, -12.5 + 5 * k, 6, 20, 0.25, 0.4, "metal"))
        m.join(crate().moved(-7, -12.5 + 5 * k, 0)).join(crate().moved(-7.2, -12.3 + 5 * k, 1)).join(
            barrel().moved(7, -11 + 4 * k, 0)
        )
    return m.join(box(-10.2, -15.2, 6.2, 10.2, 15.2, 6.3, "roof"))


def room():
    m = (
        box(-2.5, -2, -0.1, 2.5, 2, 0, "floor")
        .join(box(-2.6, 2, 0, 2.6, 2.1, 2.6, "wall"))
        .join(box(-2.6, -2, 0, -2.5, 2, 2.6, "wall"))
    )
    m.join(box(2.5, -2, 0, 2.6, 2, 2.6, "wall")).join(box(-2.6, -2.1, 0, 2.6, -2, 2.6, "wall")).join(
        box(-2.6, -2.1, 2.6, 2.6, 2.1, 2.7, "wall")
    )
    return (
        m.join(sofa().moved(0, 1.4))
        .join(table().moved(0, 0, 0, 0, 0.7))
        .join(chair().moved(-1.6, -0.4, 0, 120))
        .join(shelf().moved(2.3, 0, 0, -90))
    )


def tree(leaves="leaves"):
    m = tube([(0, 0, 0), (0.05, 0, 1.2), (0, 0.05, 2.6), (0.02, 0, 3.4)], [0.18, 0.13, 0.08, 0.03], 8, "bark")
    rng = random.Random(11)
    for _ in range(46):
        a, h, r = rng.uniform(0, 2 * math.pi), rng.uniform(1.7, 4.0), rng.uniform(0.2, 1.2)
        cx, cy, s = r * math.cos(a), r * math.sin(a), rng.uniform(0.45, 0.7)
        t, tilt = rng.uniform(0, math.pi), rng.uniform(-0.5, 0.5)
        ux, uy = math.cos(t) * s, math.sin(t) * s
        pts = [
            (cx - ux, cy - uy, h - s),
            (cx + ux, cy + uy, h - s),
            (cx + ux + tilt, cy + uy, h + s),
            (cx - ux + tilt, cy - uy, h + s),
        ]
        m.add(pts, [(0, 1, 2, 3)], leaves, [[(0, 0), (1, 0), (1, 1), (0, 1)]])
    return m


def fence(n=12):
    m = Mesh()
    for k in range(n):
        m.join(block(0.4 * k, 0, 0.6, 0.09, 0.03, 1.2, "wood"))
    return m.join(block(0.2 * (n - 1), 0.03, 0.35, 0.4 * n, 0.03, 0.08, "wood")).join(
        block(0.2 * (n - 1), 0.03, 0.9, 0.4 * n, 0.03, 0.08, "wood")
    )


def sword():
    m = tube([(0, 0, 0.1), (0, 0, 0.8), (0, 0, 0.95)], [0.03, 0.026, 0.001], 4, "metal", squash=0.2)
    return (
        m.join(block(0, 0, 0.1, 0.2, 0.03, 0.025, "gold"))
        .join(cylinder((0, 0, -0.06), (0, 0, 0.1), 0.014, 8, "wood"))
        .join(ball(0, 0, -0.08, 0.025, 0.025, 0.025, 8, 6, "gold"))
    )


def column_temple():
    m = box(-5, -8, 0, 5, 8, 0.4, "wall").join(box(-4.7, -7.7, 0.4, 4.7, 7.7, 0.8, "wall"))
    for k in range(7):
        for x in (-4.2, 4.2):
            m.join(
                tube(
                    [(x, -7.2 + 2.4 * k, 0.8), (x, -7.2 + 2.4 * k, 3), (x, -7.2 + 2.4 * k, 5)],
                    [0.42, 0.38, 0.34],
                    12,
                    "wall",
                )
            )
    return (
        m.join(box(-4.8, -7.8, 5, 4.8, 7.8, 5.6, "wall"))
        .join(prism([(-8, 5.6), (8, 5.6), (8, 5.7), (-8, 5.7)], -4.9, 4.9, 0, "wall"))
        .join(prism([(5.7, -5), (7.4, 0), (5.7, 5)][::-1], -8, 8, 1, "roof"))
    )


# pictures -----------------------------------------------------------------------------------------------------------------------------


def png(path, width, height, pixel, channels=3):
    """Writes pixel(x, y) (a tuple of channels bytes) as a PNG file."""
    raw = b"".join(b"\0" + bytes(c for x in range(width) for c in pixel(x, y)) for y in range(height))
    kind = {1: 0, 3: 2, 4: 6}[channels]

    def chunk(tag, data):
        return struct.pack(">I", len(data)) + tag + data + struct.pack(">I", zlib.crc32(tag + data))

    with open(path, "wb") as f:
        f.write(
            b"\x89PNG\r\n\x1a\n"
            + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, kind, 0, 0, 0))
            + chunk(b"IDAT", zlib.compress(raw, 9))
            + chunk(b"IEND", b"")
        )


def tga(path, width, height, pixel):
    """An uncompressed 24-bit TGA, bottom row first."""
    rows = b"".join(
        bytes(c for x in range(width) for c in reversed(pixel(x, y)[:3])) for y in reversed(range(height))
    )
    with open(path, "wb") as f:
        f.write(struct.pack("<BBBHHBHHHHBB", 0, 0, 2, 0, 0, 0, 0, 0, width, height, 24, 0) + rows)


def bmp(path, width, height, pixel):
    """A 24-bit BMP; the width is a multiple of four."""
    rows = b"".join(
        bytes(c for x in range(width) for c in reversed(pixel(x, y)[:3])) for y in reversed(range(height))
    )
    with open(path, "wb") as f:
        f.write(
            struct.pack("<2sIHHI", b"BM", 54 + len(rows), 0, 0, 54)
            + struct.pack("<IiiHHIIiiII", 40, width, height, 1, 24, 0, len(rows), 2835, 2835, 0, 0)
            + rows
        )


def noise(x, y, seed=0):
    h = (x * 374761393 + y * 668265263 + seed * 2147483647) & 0xFFFFFFFF
    h = ((h ^ (h >> 13)) * 1274126177) & 0xFFFFFFFF
    return ((h ^ (h >> 16)) & 255) / 255


def brick(x, y):
    row = y // 8
    mortar = y % 8 == 0 or (x + 8 * (row % 2)) % 16 == 0
    n = noise((x + 8 * (row % 2)) // 16, row, 1)
    return (200, 195, 185) if mortar else (int(140 + 50 * n), int(62 + 25 * n), int(45 + 15 * n))


def planks(x, y):
    n = noise(x // 16, 0, 2)
    g = math.sin(y * 0.35 + 3 * noise(x // 2, y // 9, 3)) * 12
    return (40, 25, 15) if x % 16 == 0 else tuple(max(0, min(255, int(c + g + 30 * n))) for c in (150, 100, 55))


def grass(x, y):
    n = noise(x, y, 4)
    return (int(60 + 50 * n), int(110 + 60 * n), int(40 + 25 * n))


def steel(x, y):
    n = noise(0, y, 5)
    return tuple(int(c + 30 * n) for c in (140, 145, 155))


def fabric(x, y):
    k = ((x // 2 + y // 2) % 2) * 25
    return (70 + k, 85 + k, 150 + k)


def livery(x, y):
    return (235, 235, 230) if (y // 8) % 2 else (200, 60, 40)


def leaf(x, y):
    """A branch of leaves: alpha 255 inside, 0 outside (64 x 64)."""
    inside = False
    for cx, cy in ((32, 14), (18, 30), (46, 30), (24, 48), (42, 50)):
        inside = inside or ((x - cx) / 11) ** 2 + ((y - cy) / 8) ** 2 < 1
    n = noise(x, y, 6)
    return (int(50 + 40 * n), int(120 + 60 * n), int(35 + 20 * n), 255 if inside else 0)


def paint_of(name):
    return {"brick": brick, "planks": planks, "grass": grass, "steel": steel, "fabric": fabric, "livery": livery}[
        name
    ]
