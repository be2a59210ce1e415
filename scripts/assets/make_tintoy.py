# scripts/assets/make_tintoy.py: a small room at evening, written without any modeller: the window's
# light crosses the floor, a bulb glows on the table, a marble ball rolls by.
#
#   make_tintoy.py SHADERS OUT.dae        SHADERS: the folder of the .sl files to embed
import math
import os
import sys

from dae_writer import Dae, Point, add_box, grid_of, lathe_of

FRAMES, FPS = 48, 24.0

# material: (its shaders by stage, {parameter: value}). A shader's file has its name.
MATERIALS = {
    "floor": ([("SURFACE", "planks")], {"width": 0.5, "boardlength": 5.0, "gap": 0.008,
                                        "Ks": 0.12}),
    "wall": ([("SURFACE", "plaster")], {"surface_color": (0.62, 0.50, 0.36)}),
    "trim": ([("SURFACE", "plaster")], {"surface_color": (0.70, 0.66, 0.58),
                                        "unevenness": 0.03}),
    "table": ([("SURFACE", "gloss")], {"surface_color": (0.30, 0.13, 0.05), "Ks": 0.25,
                                       "roughness": 0.15}),
    "ball": ([("SURFACE", "veined")], {"scale": 0.75}),
    "block": ([("SURFACE", "veined")], {"scale": 0.6, "bodycolor": (0.10, 0.28, 0.20),
                                        "veincolor": (0.75, 0.80, 0.68)}),
    "brass": ([("DISPLACEMENT", "threads"), ("SURFACE", "brass")], {"freq": 5.0,
                                                                  "amplitude": 0.022,
                                                                  "phase": 0.0}),
    "cap": ([("SURFACE", "brass")], {"roughness": 0.16}),
    "black": ([("SURFACE", "gloss")], {"surface_color": (0.02, 0.02, 0.022)}),
    "filament": ([("SURFACE", "filament")], {"freq": 11.0, "phase": 0.0, "width": 0.34,
                                             "glow": 1.0}),
    "filament_left": ([("SURFACE", "filament")], {"freq": 3.0, "phase": 0.0, "width": 0.34,
                                                  "glow": 1.0}),
    "wire": ([("SURFACE", "gloss")], {"surface_color": (0.30, 0.30, 0.32)}),
    "glass": ([("SURFACE", "bulbglass")], {}),
    "halo": ([("SURFACE", "halo")], {"glow": 1.0}),
}

LIGHTS = {
    "sun": ("windowlight", {"intensity": 2.8, "to": Point((0.0, 0.0, 0.0))}),
    "bulb": ("bulblight", {"glow": 1.0}),
    "room": ("skylight", {"intensity": 0.75}),
}

BULB = (1.15, 1.1, 0.0)  # where the bulb stands, on the floor plane


def rolling(frame):
    """The ball's place along x at a frame; it slows down towards the end."""
    t = frame / (FRAMES - 1)
    return -1.55 + 1.75 * (t - 0.35 * t * t) / 0.65


def build_room(dae):
    """x to the right, y into the picture, z up; the window is in the wall x = -4."""
    floor = grid_of(lambda s, t: (-4 + 8 * s, -5 + 8 * t, 0), 1, 1)
    back = grid_of(lambda s, t: (-4 + 8 * s, 3, 5 * t), 1, 1)
    right = grid_of(lambda s, t: (4, 3 - 8 * s, 5 * t), 1, 1)
    for name, mesh, material in (("floor", floor, "floor"), ("back", back, "wall"),
                                 ("right", right, "wall")):
        dae.mesh(name, mesh, material)
        dae.node(name, name, material)
    # The wall of the window, around its opening; the light's shader makes the panes.
    for name, y0, y1, z0, z1 in (("below", -5, 3, 0, 1.3), ("above", -5, 3, 3.9, 5),
                                 ("before", -5, -2.2, 1.3, 3.9), ("behind", 0.4, 3, 1.3, 3.9)):
        add_box(dae, "window_" + name, "wall", (-4.15, y0, z0), (-4, y1, z1))
    add_box(dae, "skirting", "trim", (-4, 2.94, 0), (4, 3, 0.32))
    add_box(dae, "skirting_right", "trim", (3.94, -5, 0), (4, 2.94, 0.32))


def build_toys(dae):
    ball = lathe_of(lambda t: (0.42 * math.sin(math.pi * t), -0.42 * math.cos(math.pi * t)), 64, 32)
    dae.mesh("ball", ball, "ball")
    dae.node("ball", "ball", "ball", [("translate", "place", (rolling(0), -0.35, 0.42)),
                                      ("rotate", "roll", (0, 1, 0, 0)),
                                      ("rotate", "tilt", (1, 0, 0, 35))])
    add_box(dae, "block", "block", (-0.42, -0.42, 0), (0.42, 0.42, 0.84),
            [("translate", "place", (-0.55, 1.55, 0)), ("rotate", "turn", (0, 0, 1, 24))])
    add_box(dae, "block_top", "block", (-0.30, -0.30, 0), (0.30, 0.30, 0.60),
            [("translate", "place", (-0.50, 1.55, 0.84)), ("rotate", "turn", (0, 0, 1, -17))])


def bulb_profile(t):
    """A pear: from the neck (t = 0) up to the crown (t = 1); radius and height above the base."""
    neck, round_z, radius = 0.30, 1.28, 0.66
    if t < 0.45:
        k = t / 0.45
        low, high = (neck, 0.52), (0.585, 0.97)
        blend = k * k * (3 - 2 * k)
        return low[0] + (high[0] - low[0]) * blend, low[1] + (high[1] - low[1]) * k
    a = math.radians(-28 + 118 * (t - 0.45) / 0.55)
    return max(radius * math.cos(a), 0.0), round_z + radius * math.sin(a)


def build_bulb(dae):
    """Base with threads, glass, filament of a cylinder and two cones, halo: all turn together."""
    place = [("translate", "place", BULB), ("rotate", "spin", (0, 0, 1, 0))]
    with dae.group("lamp", place):
        for name, profile, around, along, material in (
                ("contact", lambda t: (0.14 + 0.10 * t, 0.02 + 0.06 * t), 48, 2, "black"),
                ("contact_end", lambda t: (0.14 * t, 0.02), 48, 1, "black"),
                ("screw", lambda t: (0.29, 0.08 + 0.42 * t), 96, 24, "brass"),
                ("collar", lambda t: (0.315 - 0.02 * t, 0.47 + 0.06 * t), 64, 2, "cap"),
                ("stem", lambda t: (0.11 * (1 - 0.75 * t), 0.50 + 0.45 * t), 32, 6, "glass"),
                ("glass", bulb_profile, 96, 56, "glass")):
            dae.mesh(name, lathe_of(profile, around, along), material)
            dae.node(name, name, material)
        for side, name in ((-1, "wire_left"), (1, "wire_right")):
            wire = tube((side * 0.04, 0, 0.90), (side * 0.40, 0, 1.30), 0.010)
            dae.mesh(name, wire, "wire")
            dae.node(name, name, "wire")
        with dae.group("hot", [("translate", "place", (0, 0, 1.30)),
                                    ("rotate", "lie", (0, 1, 0, 90))]):
            coil = lathe_of(lambda t: (0.075, -0.24 + 0.48 * t), 48, 24)
            dae.mesh("coil", coil, "filament")
            dae.node("coil", "coil", "filament")
            for sign, name in ((-1, "cone_low"), (1, "cone_high")):
                cone = lathe_of(lambda t, s=sign: (0.075 * (1 - 0.94 * t), s * (0.24 + 0.16 * t)),
                                48, 12)
                dae.mesh(name, cone, "filament_left")
                dae.node(name, name, "filament_left")
        halo = lathe_of(lambda t: (0.36 * math.sin(math.pi * t), -0.36 * math.cos(math.pi * t)),
                        48, 24)
        dae.mesh("halo", halo, "halo")
        dae.node("halo", "halo", "halo", [("translate", "place", (0, 0, 1.30)),
                                          ("scale", "wide", (1.35, 1, 1))])
        dae.light_node("bulb", [("translate", "place", (0, 0, 1.30))])


def tube(a, b, radius, around=12):
    """A thin round bar between two points of the plane y = 0."""
    length = math.hypot(b[0] - a[0], b[2] - a[2])
    ex, ez = (b[0] - a[0]) / length, (b[2] - a[2]) / length

    def point(s, t):
        c, d = radius * math.cos(2 * math.pi * s), radius * math.sin(2 * math.pi * s)
        along = length * t
        return (a[0] + ex * along + ez * c, d, a[2] + ez * along - ex * c)

    return grid_of(point, around, 1)


def animate(dae):
    frames = range(1, FRAMES + 1)
    times = [frame / FPS for frame in frames]
    x = [rolling(frame - 1) for frame in frames]
    dae.channel("ball/place.X", times, x)
    dae.channel("ball/roll.ANGLE", times, [math.degrees((v - x[0]) / 0.42) for v in x])
    dae.channel("lamp/spin.ANGLE", [times[0], times[-1]], [-25.0, 65.0])
    # A lamp on an old line: its light breathes; light, filament and halo follow the same curve.
    glow = [1.0 + 0.10 * math.sin(0.9 * f) + 0.08 * math.sin(0.37 * f + 1) for f in frames]
    for target in ("bulb-effect/glow", "filament-material/glow", "filament_left-material/glow",
                   "halo-material/glow"):
        dae.channel(target, times, glow)
    dae.channel("filament-material/phase", [times[0], times[-1]], [0.0, 1.0])
    # The sun sinks: the panes climb and wander over the room.
    dae.channel("sun-effect/to", [times[0], times[-1]], [(-0.35, -0.55, 0.0), (0.75, 0.95, 0.45)])


def main(shaders, path):
    def code(name):
        with open(os.path.join(shaders, name + ".sl")) as file:
            return file.read()

    dae = Dae()
    for name, (stages, values) in MATERIALS.items():
        dae.material(name, [(stage, shader, code(shader)) for stage, shader in stages], values)
    for name, (shader, values) in LIGHTS.items():
        dae.light(name, shader, code(shader), values)
    build_room(dae)
    build_toys(dae)
    build_bulb(dae)
    dae.light_node("sun")
    dae.light_node("room")
    dae.camera("camera", 40.0, 16 / 9, [("lookat", "view", (0.75, -6.3, 1.75, 0.2, 1.0, 0.98,
                                                            0, 0, 1))])
    animate(dae)
    dae.write(path)


main(*sys.argv[1:])
