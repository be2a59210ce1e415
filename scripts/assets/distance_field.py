# scripts/assets/distance_field.py: solids as signed distances, and their surface as quads.
#
# A solid is a function from points (n x 3) to distances (n), negative inside.
import numpy as np


def capsule(a, b, ra, rb=None):
    """A cone with round ends: from a (radius ra) to b (radius rb)."""
    a, b = np.array(a, float), np.array(b, float)
    rb = ra if rb is None else rb

    def distance(p):
        along = np.clip((p - a) @ (b - a) / np.dot(b - a, b - a), 0.0, 1.0)
        nearest = a + along[:, None] * (b - a)
        return np.linalg.norm(p - nearest, axis=1) - (ra + along * (rb - ra))

    return distance


def ellipsoid(center, radii, pitch_degrees=0.0):
    """Near its surface a good bound of the distance; pitch turns it about y (nose down)."""
    center, radii = np.array(center, float), np.array(radii, float)
    c, s = np.cos(np.radians(pitch_degrees)), np.sin(np.radians(pitch_degrees))
    turn = np.array([[c, 0, s], [0, 1, 0], [-s, 0, c]])

    def distance(p):
        q = (p - center) @ turn
        k0 = np.linalg.norm(q / radii, axis=1)
        k1 = np.linalg.norm(q / (radii * radii), axis=1)
        return k0 * (k0 - 1.0) / np.maximum(k1, 1e-9)

    return distance


def ring(center, axis, radius, thickness, half_plane=None):
    """A torus; with half_plane = (point, normal) only the part on the normal's side."""
    center, axis = np.array(center, float), np.array(axis, float)

    def distance(p):
        q = p - center
        h = q @ axis
        flat = np.linalg.norm(q - h[:, None] * axis, axis=1)
        d = np.hypot(flat - radius, h) - thickness
        if half_plane is not None:
            d = np.maximum(d, -(p - np.array(half_plane[0])) @ np.array(half_plane[1]))
        return d

    return distance


def disc(center, axis, radius, half_height, rounding):
    """A cylinder with rounded rims."""
    center, axis = np.array(center, float), np.array(axis, float)

    def distance(p):
        q = p - center
        h = np.abs(q @ axis) - half_height + rounding
        flat = np.linalg.norm(q - (q @ axis)[:, None] * axis, axis=1) - radius + rounding
        outside = np.hypot(np.maximum(flat, 0), np.maximum(h, 0))
        return outside + np.minimum(np.maximum(flat, h), 0) - rounding

    return distance


def join(k, *solids):
    """Union; seams are rounded over a width of about k."""

    def distance(p):
        d = solids[0](p)
        for solid in solids[1:]:
            e = solid(p)
            h = np.maximum(k - np.abs(d - e), 0.0) / k
            d = np.minimum(d, e) - h * h * k * 0.25
        return d

    return distance


def carve(k, solid, tool):
    """solid without tool; the edge is rounded over about k."""

    def distance(p):
        d, e = solid(p), -tool(p)
        h = np.maximum(k - np.abs(d - e), 0.0) / k
        return np.maximum(d, e) + h * h * k * 0.25

    return distance


def gradient(solid, p, step=1e-4):
    columns = []
    for axis in range(3):
        offset = np.zeros(3)
        offset[axis] = step
        columns.append((solid(p + offset) - solid(p - offset)) / (2 * step))
    return np.stack(columns, axis=1)


def surface(solid, low, high, cell):
    """Surface nets: one vertex in each cell the surface passes, one quad across each grid edge
    it crosses. Vertices are evened out and put back onto the surface. Returns points and quads."""
    low, high = np.array(low, float), np.array(high, float)
    size = np.ceil((high - low) / cell).astype(int) + 1
    axes = [low[i] + cell * np.arange(size[i]) for i in range(3)]
    values = np.empty(size)
    for i, x in enumerate(axes[0]):  # a slab at a time keeps memory small
        y, z = np.meshgrid(axes[1], axes[2], indexing="ij")
        slab = np.stack([np.full(y.size, x), y.ravel(), z.ravel()], axis=1)
        values[i] = solid(slab).reshape(size[1], size[2])
    inside = values < 0

    corners = sum(inside[i : size[0] - 1 + i, j : size[1] - 1 + j, k : size[2] - 1 + k].astype(int)
                  for i in (0, 1) for j in (0, 1) for k in (0, 1))
    mixed = (corners > 0) & (corners < 8)
    number = np.full(mixed.shape, -1)
    cells = np.argwhere(mixed)
    number[mixed] = np.arange(len(cells))
    points = low + cell * (cells + 0.5)

    quads = []
    for axis in range(3):
        b, c = (axis + 1) % 3, (axis + 2) % 3
        first = np.take(inside, range(size[axis] - 1), axis)
        second = np.take(inside, range(1, size[axis]), axis)
        for crossing, flip in ((first & ~second, False), (~first & second, True)):
            edge = np.argwhere(crossing)
            edge = edge[(edge[:, b] > 0) & (edge[:, c] > 0)]
            around = []
            for db, dc in ((1, 1), (0, 1), (0, 0), (1, 0)):
                at = edge.copy()
                at[:, b] -= db
                at[:, c] -= dc
                around.append(number[at[:, 0], at[:, 1], at[:, 2]])
            quad = np.stack(around, axis=1)
            quads.append(quad[:, ::-1] if flip else quad)
    quads = np.concatenate(quads)
    quads = quads[(quads >= 0).all(axis=1)]

    for _ in range(6):
        points = project(solid, points, cell)
        points += 0.5 * (neighbour_mean(points, quads) - points)
    return project(solid, project(solid, points, cell), cell), quads


def project(solid, points, limit):
    g = gradient(solid, points)
    move = solid(points)[:, None] * g / np.maximum((g * g).sum(axis=1), 0.25)[:, None]
    return points - np.clip(move, -limit, limit)


def neighbour_mean(values, quads):
    total = np.zeros_like(values)
    count = np.zeros(len(values))
    for i in range(4):
        a, b = quads[:, i], quads[:, (i + 1) % 4]
        np.add.at(total, a, values[b])
        np.add.at(total, b, values[a])
        np.add.at(count, a, 1)
        np.add.at(count, b, 1)
    return total / np.maximum(count, 1)[:, None]
