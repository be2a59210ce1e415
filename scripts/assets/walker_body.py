# scripts/assets/walker_body.py: the walker: a statue in sneakers, with headphones.
#
# Metres, z up, facing +x, left is +y. Every solid belongs to a joint: skin weights follow from how
# near a joint's solids are.
import numpy as np

import distance_field as df

# joint: (parent, head, tail). The left side; the right one mirrors it.
CENTRE = {
    "root": (None, (0, 0, 0), (0.2, 0, 0)),
    "hips": ("root", (0, 0, 0.92), (0, 0, 1.02)),
    "spine": ("hips", (0, 0, 1.02), (0, 0, 1.17)),
    "chest": ("spine", (0, 0, 1.17), (-0.01, 0, 1.42)),
    "neck": ("chest", (-0.01, 0, 1.42), (0.01, 0, 1.52)),
    "head": ("neck", (0.01, 0, 1.52), (0.01, 0, 1.78)),
}
SIDE = {
    "clavicle": ("chest", (0.0, 0.04, 1.385), (0, 0.185, 1.375)),
    "upperarm": ("clavicle", (0, 0.185, 1.375), (-0.005, 0.355, 1.165)),
    "forearm": ("upperarm", (-0.005, 0.355, 1.165), (0.02, 0.503, 0.982)),
    "hand": ("forearm", (0.02, 0.503, 0.982), (0.03, 0.556, 0.914)),
    "fingers": ("hand", (0.03, 0.556, 0.914), (0.035, 0.605, 0.842)),
    "thumb": ("hand", (0.045, 0.515, 0.955), (0.095, 0.54, 0.9)),
    "thigh": ("hips", (0, 0.095, 0.90), (0.012, 0.1, 0.49)),
    "shin": ("thigh", (0.012, 0.1, 0.49), (-0.02, 0.1, 0.09)),
    "foot": ("shin", (-0.02, 0.1, 0.09), (0.1, 0.108, 0.03)),
    "toe": ("foot", (0.1, 0.108, 0.03), (0.19, 0.113, 0.03)),
}


def mirrored(p):
    return (p[0], -p[1], p[2])


def joints():
    table = {name: (parent, np.array(h, float), np.array(t, float))
             for name, (parent, h, t) in CENTRE.items()}
    for suffix, place in (("_L", lambda p: p), ("_R", mirrored)):
        for name, (parent, h, t) in SIDE.items():
            parent = parent if parent in CENTRE else parent + suffix
            table[name + suffix] = (parent, np.array(place(h), float), np.array(place(t), float))
    return table


def hair():
    """A cap of curls above and behind a hairline."""
    cap = df.ellipsoid((-0.018, 0, 1.655), (0.112, 0.094, 0.114))

    def distance(p):
        q = (p - np.array((-0.018, 0, 1.655))) / np.array((0.112, 0.094, 0.114))
        around = np.arctan2(q[:, 1], q[:, 0])
        height = np.arcsin(np.clip(q[:, 2] / np.maximum(np.linalg.norm(q, axis=1), 1e-9), -1, 1))
        row = height * 5.2
        curls = np.cos(2 * np.pi * row) * np.cos(around * 13 * np.cos(0.8 * height))
        hairline = (p - np.array((0.058, 0, 1.69))) @ np.array((0.78, 0, -0.63))
        nape = 1.575 - p[:, 2]
        return np.maximum(cap(p) - 0.006 * curls, np.maximum(hairline, nape))

    return distance


def head_solid():
    skull = df.ellipsoid((-0.012, 0, 1.648), (0.108, 0.088, 0.112))
    face = df.ellipsoid((0.028, 0, 1.61), (0.076, 0.068, 0.108))
    chin = df.ellipsoid((0.066, 0, 1.528), (0.026, 0.030, 0.022))
    solid = df.join(0.05, skull, face, chin)
    brow = df.capsule((0.098, -0.026, 1.652), (0.098, 0.026, 1.652), 0.009)
    solid = df.join(0.03, solid, brow)
    for side in (-1, 1):
        socket = df.ellipsoid((0.117, 0.036 * side, 1.627), (0.024, 0.023, 0.016))
        solid = df.carve(0.018, solid, socket)
        eye = df.ellipsoid((0.079, 0.033 * side, 1.627), (0.0165, 0.0165, 0.0145))
        solid = df.join(0.006, solid, eye)
        ear = df.ellipsoid((-0.01, 0.087 * side, 1.62), (0.022, 0.011, 0.032))
        solid = df.join(0.012, solid, ear)
    nose = df.join(0.012, df.capsule((0.097, 0, 1.645), (0.119, 0, 1.596), 0.0075, 0.0125),
                   df.capsule((0.106, -0.012, 1.592), (0.106, 0.012, 1.592), 0.008))
    solid = df.join(0.014, solid, nose)
    lips = df.join(0.004, df.capsule((0.0905, -0.019, 1.5625), (0.0905, 0.019, 1.5625), 0.0068),
                   df.capsule((0.0895, -0.015, 1.5505), (0.0895, 0.015, 1.5505), 0.0075))
    return df.join(0.008, df.join(0.010, solid, lips), hair())


def arm_solids(m):
    """By joint, for the left arm (m = identity) or the right one (m = mirrored)."""
    s = SIDE
    shoulder, elbow, wrist = s["upperarm"][1], s["forearm"][1], s["hand"][1]
    knuckle = np.array(s["fingers"][1])
    out, front = np.array((0.007, 0.052, -0.072)), np.array((1.0, 0, 0))
    fingers = []
    for i, spread in enumerate((0.030, 0.011, -0.008, -0.026)):
        a = knuckle + front * spread
        b = a + out * (0.72, 0.86, 0.80, 0.62)[i] * 0.55 + front * spread * 0.12
        c = b + out * (0.72, 0.86, 0.80, 0.62)[i] * 0.50 + np.array((0.004, -0.007, -0.002))
        fingers.append(df.join(0.004, df.capsule(m(a), m(b), 0.0108, 0.0098),
                               df.capsule(m(b), m(c), 0.0098, 0.0085)))
    palm = df.join(0.02, df.capsule(m(wrist), m(knuckle + front * 0.022), 0.021, 0.014),
                   df.capsule(m(wrist), m(knuckle - front * 0.020), 0.021, 0.014))
    t0, t1 = np.array(s["thumb"][1]), np.array(s["thumb"][2])
    thumb = df.join(0.01, df.capsule(m(wrist), m(t0), 0.018, 0.015),
                    df.capsule(m(t0), m(t1), 0.0145, 0.0095))
    bicep = np.array(shoulder) * 0.55 + np.array(elbow) * 0.45
    belly = np.array(elbow) * 0.72 + np.array(wrist) * 0.28
    return {
        "clavicle": df.capsule(m((0, 0.06, 1.385)), m((0, 0.155, 1.38)), 0.052, 0.056),
        "upperarm": df.join(0.03, df.capsule(m(shoulder), m(bicep), 0.062, 0.050),
                            df.capsule(m(bicep), m(elbow), 0.050, 0.037)),
        "forearm": df.join(0.02, df.capsule(m(elbow), m(belly), 0.037, 0.042),
                           df.capsule(m(belly), m(wrist), 0.042, 0.024)),
        "hand": palm,
        "fingers": df.join(0.0025, *fingers),
        "thumb": thumb,
    }


def leg_solids(m):
    s = SIDE
    hip, knee, ankle = s["thigh"][1], s["shin"][1], s["foot"][1]
    mid = np.array(hip) * 0.65 + np.array(knee) * 0.35 + np.array((0.008, 0, 0))
    calf = np.array(knee) * 0.68 + np.array(ankle) * 0.32 + np.array((-0.018, 0.003, 0))
    return {
        "thigh": df.join(0.03, df.capsule(m(hip), m(mid), 0.090, 0.080),
                         df.capsule(m(mid), m(knee), 0.080, 0.053),
                         df.ellipsoid(m((-0.055, 0.075, 0.865)), (0.07, 0.075, 0.085))),
        "shin": df.join(0.025, df.capsule(m(knee), m(calf), 0.053, 0.054),
                        df.capsule(m(calf), m(ankle), 0.052, 0.032),
                        df.ellipsoid(m((0.036, 0.1, 0.50)), (0.030, 0.034, 0.045))),
        "foot": df.capsule(m(ankle), m((0.05, 0.104, 0.05)), 0.034, 0.026),
    }


def body_solids():
    """joint name -> solid."""
    solids = {
        "hips": df.join(0.05, df.ellipsoid((0, 0, 0.935), (0.105, 0.150, 0.085)),
                        df.capsule((0.0, 0, 0.94), (0, 0, 1.03), 0.105, 0.10)),
        "spine": df.ellipsoid((0.004, 0, 1.09), (0.092, 0.122, 0.12)),
        "chest": df.join(0.05, df.ellipsoid((-0.005, 0, 1.245), (0.108, 0.150, 0.145)),
                         df.ellipsoid((0.055, 0.068, 1.288), (0.060, 0.078, 0.058)),
                         df.ellipsoid((0.055, -0.068, 1.288), (0.060, 0.078, 0.058)),
                         df.capsule((-0.02, -0.10, 1.36), (-0.02, 0.10, 1.36), 0.062)),
        "neck": df.capsule((-0.012, 0, 1.40), (0.006, 0, 1.54), 0.056, 0.050),
        "head": head_solid(),
    }
    for suffix, m in (("_L", lambda p: tuple(p)), ("_R", mirrored)):
        for name, solid in {**arm_solids(m), **leg_solids(m)}.items():
            solids[name + suffix] = solid
    return solids


def body():
    """The whole statue as one solid; limbs melt into the trunk, fingers do not melt together."""
    s = body_solids()
    trunk = df.join(0.07, s["hips"], s["spine"], s["chest"])
    trunk = df.join(0.035, trunk, s["neck"])
    for side in ("_L", "_R"):
        leg = df.join(0.03, s["thigh" + side], s["shin" + side], s["foot" + side])
        arm = df.join(0.025, s["upperarm" + side], s["forearm" + side])
        hand = df.join(0.012, s["hand" + side], s["thumb" + side])
        hand = df.join(0.008, hand, s["fingers" + side])
        arm = df.join(0.02, arm, hand)
        trunk = df.join(0.045, trunk, leg)
        trunk = df.join(0.05, trunk, df.join(0.04, s["clavicle" + side], arm))
    return df.join(0.02, trunk, s["head"])


def shoe_solids(m):
    """A sneaker: upper, thick sole, collar, by joint."""
    heel = df.join(0.03, df.ellipsoid(m((-0.035, 0.1, 0.062)), (0.056, 0.046, 0.056)),
                   df.capsule(m((-0.022, 0.1, 0.085)), m((-0.021, 0.1, 0.122)), 0.047, 0.046),
                   df.ellipsoid(m((0.045, 0.104, 0.05)), (0.075, 0.046, 0.050), 16))
    toe = df.ellipsoid(m((0.125, 0.109, 0.036)), (0.085, 0.050, 0.038))
    sole_back = df.capsule(m((-0.045, 0.1, 0.008)), m((0.06, 0.105, 0.008)), 0.047, 0.049)
    sole_front = df.capsule(m((0.06, 0.105, 0.008)), m((0.155, 0.109, 0.010)), 0.049, 0.050)

    def slab(solid):
        return lambda p: np.maximum(solid(p), np.abs(p[:, 2] - 0.0125) - 0.0125) - 0.004

    def opened(solid):  # where the leg goes in
        return lambda p: np.maximum(solid(p), p[:, 2] - 0.128)

    collar = df.ring(m((-0.021, 0.1, 0.122)), (0, 0, 1), 0.040, 0.011)
    return {"foot": df.join(0.008, df.join(0.02, opened(heel), collar), slab(sole_back)),
            "toe": df.join(0.008, toe, slab(sole_front))}


def headphones():
    band = df.ring((-0.01, 0, 1.66), (1, 0, 0), 0.126, 0.011, ((0, 0, 1.64), (0, 0, 1)))
    pad = df.ring((-0.01, 0, 1.668), (1, 0, 0), 0.120, 0.015, ((0, 0, 1.74), (0, 0, 1)))
    solid = df.join(0.008, band, pad)
    for side in (-1, 1):
        cup = df.disc((-0.01, 0.119 * side, 1.62), (0, 1, 0), 0.046, 0.019, 0.012)
        cap = df.disc((-0.01, 0.139 * side, 1.62), (0, 1, 0), 0.030, 0.007, 0.005)
        cushion = df.ring((-0.01, 0.099 * side, 1.62), (0, 1, 0), 0.031, 0.014)
        solid = df.join(0.004, solid, df.join(0.005, df.join(0.005, cup, cap), cushion))
    return solid


def weights(points, quads, solids, spread=0.018, smoothing=4, most=4):
    """Per vertex: at most `most` (joint, weight) pairs that sum to 1. Weights fall off with the
    distance to a joint's solids beyond that of the nearest joint."""
    names = sorted(solids)
    distances = np.stack([solids[name](points) for name in names], axis=1)
    w = np.exp(-(distances - distances.min(axis=1, keepdims=True)) / spread)
    w /= w.sum(axis=1, keepdims=True)
    for _ in range(smoothing):
        w = 0.5 * w + 0.5 * df.neighbour_mean(w, quads)
    least = np.sort(w, axis=1)[:, -min(most, len(names))][:, None]
    w = np.where((w >= least) & (w > 0.02), w, 0.0)
    w /= w.sum(axis=1, keepdims=True)
    return [[(names[j], round(float(row[j]), 4)) for j in np.nonzero(row)[0]] for row in w]
