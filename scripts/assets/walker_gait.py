# scripts/assets/walker_gait.py: the walk: where each joint is and how it is turned, each frame.
#
# Phases run 0..1 over a cycle from one left heel strike to the next. Turns are about the world's
# axes, relative to the rest pose. The walker goes along +x.
import numpy as np

from walker_body import joints

FRAMES = 72
CYCLE = 24  # frames: two steps a second at 24 fps
STRIDE = 1.12  # metres a cycle
STANCE = 0.62  # part of a cycle that a foot is on the ground
SOLE = 0.004  # below z = 0 in the rest pose
START = -1.75  # x of the pelvis at phase 0
HEEL, BALL = np.array((-0.07, 0, -0.09)), np.array((0.115, 0, -0.09))  # from the ankle
STRIKE, PUSH = -18.0, 48.0  # pitch of the foot (degrees, toes down positive) at its two ends


def turn(axis, degrees):
    a = np.radians(degrees)
    c, s = np.cos(a), np.sin(a)
    return np.array({"x": ((1, 0, 0), (0, c, -s), (0, s, c)),
                     "y": ((c, 0, s), (0, 1, 0), (-s, 0, c)),
                     "z": ((c, -s, 0), (s, c, 0), (0, 0, 1))}[axis])


def ease(low, high, x):
    t = np.clip((x - low) / (high - low), 0, 1)
    return t * t * (3 - 2 * t)


def foot_pitch(p):
    """p = 0: the heel strikes."""
    if p < STANCE:
        return STRIKE * (1 - ease(0, 0.11, p)) + PUSH * ease(0.34, STANCE + 0.03, p)
    swing = (p - STANCE) / (1 - STANCE)
    start = PUSH * ease(0.34, STANCE + 0.03, STANCE)
    return start + (8 - start) * ease(0, 0.5, swing) + (STRIKE - 8) * ease(0.45, 0.95, swing)


def planted(p, flat_ankle):
    """The ankle of a foot that rolls over its heel, then lies flat, then rolls over its ball."""
    pitch = foot_pitch(p)
    pivot = HEEL if pitch < 0 else BALL
    return flat_ankle + pivot - turn("y", pitch) @ pivot


def ankle(phase, offset, y):
    """World place of the ankle of a foot that strikes where phase + offset is whole."""
    cycle = np.floor(phase + offset)
    p = phase + offset - cycle
    flat = np.array((START + 0.27 + (cycle - offset) * STRIDE, y, 0.09 + SOLE))
    if p <= STANCE:
        return planted(p, flat)
    t = (p - STANCE) / (1 - STANCE)
    lifted, landed = planted(STANCE, flat), planted(0.0, flat + np.array((STRIDE, 0, 0)))
    place = lifted + (landed - lifted) * (0.35 * t + 0.65 * ease(0, 1, t))
    place[2] += 0.045 * np.sin(np.pi * t) ** 1.5
    return place


def frame_of(direction, lateral):
    """Columns: along the bone, its lateral axis, and across."""
    n = lateral - direction * np.dot(lateral, direction)
    n /= np.linalg.norm(n)
    return np.stack((direction, n, np.cross(direction, n)), axis=1)


def unit(v):
    return v / np.linalg.norm(v)


def two_bones(hip, target, forward, rest):
    """Turns of thigh and shin that bring the ankle to target, the knee bent forward."""
    h, k, a = rest
    l1, l2 = np.linalg.norm(k - h), np.linalg.norm(a - k)
    u = target - hip
    d = min(np.linalg.norm(u), 0.9995 * (l1 + l2))
    u = unit(u)
    bend = np.arccos((l1 * l1 + d * d - l2 * l2) / (2 * l1 * d))
    front = unit(forward - u * np.dot(forward, u))
    thigh = np.cos(bend) * u + np.sin(bend) * front
    shin = unit(u * d - thigh * l1)
    side = np.cross(forward, u)
    y = np.array((0.0, 1.0, 0.0))
    return (frame_of(thigh, side) @ frame_of(unit(k - h), y).T,
            frame_of(shin, side) @ frame_of(unit(a - k), y).T)


def trunk_turns(phase):
    beat, w = np.cos(4 * np.pi * phase), 2 * np.pi * phase
    lean = 3.0
    pelvis = turn("z", -6 * np.cos(w)) @ turn("x", 3.5 * np.sin(w)) @ turn("y", lean)
    spine = turn("z", 0.5 * np.cos(w)) @ turn("x", -0.5 * np.sin(w)) @ turn("y", lean - 1.5)
    chest = turn("z", 7 * np.cos(w)) @ turn("x", -2.2 * np.sin(w)) @ turn("y", 1.2 * beat)
    # He nods to his music and now and then looks towards us.
    look = -34 * ease(0.75, 1.15, phase) * (1 - ease(1.9, 2.35, phase))
    head = turn("z", look + 2 * np.cos(w)) @ turn("x", 3 * np.sin(w)) @ turn(
        "y", 3 + 5 * np.cos(4 * np.pi * (phase - 0.08)))
    neck = turn("z", 0.4 * look) @ turn("y", 7 + 2 * beat)
    return {"hips": pelvis, "spine": spine, "chest": chest, "neck": neck, "head": head}


def arm_turns(chest, phase, side):
    """phase: of the leg on the same side, which the arm swings against."""
    swing = np.cos(2 * np.pi * (phase - 0.02))
    late = np.cos(2 * np.pi * (phase - 0.07))
    base = chest @ turn("z", 6 * side * swing)
    drop = turn("x", -side * 27)
    upper = base @ turn("x", side * 2) @ turn("y", 2 + 27 * swing) @ drop
    inwards = turn("z", -side * 14)
    fore = base @ inwards @ turn("y", -16 + 28 * swing - 6 * (1 - late)) @ drop
    hand = base @ inwards @ turn("y", -22 + 28 * swing - 8 * (1 - late)) @ turn("x", -side * 22)
    curl = turn("x", -side * 20)
    return {"clavicle": chest @ turn("z", 3 * side * swing), "upperarm": upper, "forearm": fore,
            "hand": hand, "fingers": hand @ curl, "thumb": hand @ turn("z", -side * 10)}


def pose(phase):
    """joint -> (turn, head) at a phase."""
    rest = joints()
    w = 2 * np.pi * phase
    turns = {"root": np.eye(3), **trunk_turns(phase)}
    heads = {"root": np.array((START + STRIDE * phase, 0.0, 0.0))}
    heads["hips"] = np.array((START + STRIDE * phase + 0.010 * np.sin(2 * w), 0.020 * np.sin(w),
                              0.890 + SOLE - 0.016 * np.cos(2 * (w - 0.4))))

    def place(name):
        parent, head, _ = rest[name]
        heads[name] = heads[parent] + turns[parent] @ (head - rest[parent][1])

    for name in ("spine", "chest", "neck", "head"):
        place(name)
    for suffix, side, offset in (("_L", 1, 0.0), ("_R", -1, 0.5)):
        for name, q in arm_turns(turns["chest"], phase + offset, side).items():
            turns[name + suffix] = q
            place(name + suffix)
        thigh, shin, foot, toe = (n + suffix for n in ("thigh", "shin", "foot", "toe"))
        place(thigh)
        target = ankle(phase, offset, 0.078 * side)
        forward = turns["hips"] @ np.array((1.0, 0.06 * side, 0.0))
        turns[thigh], turns[shin] = two_bones(heads[thigh], target, unit(forward),
                                              [rest[n][1] for n in (thigh, shin, foot)])
        pitch = foot_pitch((phase + offset) % 1.0)
        splay = turn("z", 5 * side)
        turns[foot] = splay @ turn("y", pitch)
        p = (phase + offset) % 1.0
        rolling = p < STANCE + 0.05 and pitch > 0  # the toes stay flat while the heel lifts
        bend = 0.15 * pitch if rolling else 0.9 * pitch - 4 * ease(STANCE, 0.8, p)
        turns[toe] = splay @ turn("y", bend)
        for name in (shin, foot, toe):
            place(name)
    return {name: (turns[name], heads[name]) for name in rest}


def walk():
    """One pose a frame, frame 1 first."""
    return [pose(0.08 + frame / CYCLE) for frame in range(FRAMES)]
