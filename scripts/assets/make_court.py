# scripts/assets/make_court.py: a cobbled court with a pond, a dented ball and a twisting column:
# displacement that runs once (cobbles, dents), at each frame (the pond's ripples), and a
# transformation that sways.
#
#   make_court.py SHADERS OUT.dae        SHADERS: assets/shaders
import math
import os
import sys

from dae_writer import Dae, grid_of, lathe_of

FPS = 24.0
FRAMES = 72

# material: ([(stage, folder, shader)], parameters)
MATERIALS = {
    "court": ([("DISPLACEMENT", "displacement", "cobbles"), ("SURFACE", "surface", "wetstone")],
              {"height": 0.11, "scale": 1.7, "stonecolor": (0.36, 0.32, 0.29)}),
    "pond": ([("DISPLACEMENT", "displacement", "ripples"), ("SURFACE", "surface", "water")],
             {"amplitude": 0.05, "wavelength": 0.5, "ripple": 0.004}),
    "rim": ([("DISPLACEMENT", "displacement", "weathered"), ("SURFACE", "surface", "sandstone")],
            {}),
    "ball": ([("DISPLACEMENT", "displacement", "dents"), ("SURFACE", "surface", "gold")],
             {"Km": 0.35, "power": 4.0}),
    "column": ([("TRANSFORMATION", "transformation", "twist"), ("SURFACE", "surface", "jade")],
               {"turn": 75.0}),
}


def flat(half):
    return grid_of(lambda s, t: ((2 * s - 1) * half, (2 * t - 1) * half, 0), 1, 1)


def disc(radius):
    return grid_of(lambda s, t: (radius * (1 - t) * math.cos(2 * math.pi * s),
                                 radius * (1 - t) * math.sin(2 * math.pi * s), 0), 24, 3)


def ring(t):
    """The profile of the pond's rim: up outside, over, down inside."""
    radius = [2.35, 2.35, 2.25, 1.95, 1.85, 1.85]
    height = [0.0, 0.30, 0.40, 0.40, 0.30, 0.0]
    k = min(int(t * 5), 4)
    f = t * 5 - k
    return radius[k] + f * (radius[k + 1] - radius[k]), height[k] + f * (height[k + 1] - height[k])


def column(around, along):
    """A square bar whose edges are rounded: around in s, up in t."""

    def point(s, t):
        a = 2 * math.pi * s
        c, d = math.cos(a), math.sin(a)
        r = 0.42 / (abs(c) ** 6 + abs(d) ** 6) ** (1 / 6)
        return r * c, r * d, 2.5 * t

    return grid_of(point, around, along)


def main(shaders, path):
    def code(folder, name):
        with open(os.path.join(shaders, folder, name + ".sl")) as file:
            return file.read()

    dae = Dae()
    for name, (stages, values) in MATERIALS.items():
        dae.material(name, [(stage, shader, code(folder, shader))
                            for stage, folder, shader in stages], values)
    dae.light("sky", "skydome", code("light", "skydome"), {"intensity": 0.9})
    dae.light("sun", "distantlight", code("", "distantlight"),
              {"intensity": 1.6, "lightcolor": (1.0, 0.86, 0.66)})
    dae.mesh("court", flat(12), "court")
    dae.node("court", "court", "court")
    dae.mesh("pond", disc(2.1), "pond")
    dae.mesh("rim", lathe_of(ring, 48, 5), "rim")
    with dae.group("basin", [("translate", "place", (-1.2, 1.2, 0.0))]):
        dae.node("rim", "rim", "rim")
        dae.node("pond", "pond", "pond", [("translate", "place", (0, 0, 0.22))])
    ball = lathe_of(lambda t: (math.sin(math.pi * t), -math.cos(math.pi * t)), 32, 16)
    dae.mesh("ball", ball, "ball")
    dae.node("ball", "ball", "ball", [("translate", "place", (2.0, -1.3, 1.0)),
                                      ("rotate", "roll", (0, 1, 0, 0))])
    dae.mesh("column", column(32, 24), "column")
    dae.node("column", "column", "column", [("translate", "place", (2.9, 2.6, 0.0))])
    dae.light_node("sky")
    dae.light_node("sun", [("lookat", "aim", (-6, -3, 5, 0, 0, 0, 0, 0, 1))])
    dae.camera("camera", 42.0, 16 / 9, [("lookat", "view", (-1.2, -8.6, 3.8, 0.6, 0.3, 0.75,
                                                            0, 0, 1))])
    times = [1 / FPS, FRAMES / FPS]
    dae.channel("column-material/turn", times, [40.0, 110.0])
    dae.channel("ball/roll.ANGLE", times, [0.0, 40.0])
    dae.write(path)


main(*sys.argv[1:])
