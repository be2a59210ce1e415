# scripts/assets/make_attach.py: the stage of docs/attach.md: a ball on a floor, a glowing panel, posts
# that go away from the eye, one lamp. scripts/attach_examples hangs a shader on one of them.
#
#   make_attach.py OUT.dae
import math
import sys

from dae_writer import Dae, add_box, grid_of, lathe_of

MATTE = """surface %s(color tint = color(%s);)
{
    normal Nf = faceforward(normalize(N), I);
    Oi = 1;
    Ci = tint * (ambient() + diffuse(Nf));
}
"""
TINTS = {"clay": "0.7, 0.42, 0.3", "floor": "0.5, 0.5, 0.52", "panel": "0.75, 0.75, 0.75", "post": "0.35, 0.4, 0.5"}
LIGHTS = """light %s(float intensity = %g;)
{
    %s
}
"""
LAMP = 'illuminate(point "shader" (0, 0, 0)) Cl = intensity / (L . L);'
SKY = "Cl = intensity * color(0.8, 0.9, 1);"


def main(path):
    dae = Dae()
    for name, tint in TINTS.items():
        dae.material(name, [("SURFACE", name, MATTE % (name, tint))], {})
    dae.light("lamp", "lamp", LIGHTS % ("lamp", 22, LAMP), {})
    dae.light("sky", "sky", LIGHTS % ("sky", 0.25, SKY), {})
    dae.mesh("floor", grid_of(lambda s, t: (40 * s - 20, 44 * t - 8, 0), 1, 1), "floor", flat=True)
    dae.node("floor", "floor", "floor")
    ball = lathe_of(lambda t: (math.sin(math.pi * t), -math.cos(math.pi * t)), 32, 16)
    dae.mesh("ball", ball, "clay")
    dae.node("ball", "ball", "clay", [("translate", "place", (0, 0, 1))])
    add_box(dae, "panel", "panel", (-0.04, -0.5, -0.5), (0.04, 0.5, 0.5),
            [("translate", "place", (-2.1, 0.5, 1.0)), ("rotate", "turn", (0, 0, 1, -25))])
    for i in range(5):
        add_box(dae, f"post{i}", "post", (-0.12, -0.12, 0), (0.12, 0.12, 2.4),
                [("translate", "place", (2.5 - 0.3 * i, 0.8 + 2.7 * i, 0))])
    dae.light_node("lamp", [("translate", "place", (1.5, -3.5, 4.2))])
    dae.light_node("sky")
    dae.camera("camera", 40.0, 3 / 2, [("lookat", "view", (0.35, -6.2, 2.1, 0.15, 0, 0.95, 0, 0, 1))])
    dae.write(path)


main(*sys.argv[1:])
