"""scripts/sheet/stage.py: the studio that a shader is photographed in, one scene for each kind.

A scene is written with scripts/assets/dae_writer.py; x goes right, y into the picture, z up. Every
shader is shown with its defaults.
"""
import math
import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SHADERS = ROOT / "assets/shaders"
sys.path.insert(0, str(ROOT / "scripts/assets"))
from sheet import png  # noqa: E402
from dae_writer import Dae, Point, add_box, grid_of, lathe_of  # noqa: E402

KINDS = ("surface", "displacement", "light", "volume", "imager", "transformation",
         "deformation")
KEY = ("lookat", "aim", (-3.4, -3.9, 5.4, 0, 0, 0.8, 0, 0, 1))
# Looks of flat things are shown on the floor and on a block; thin ones on a sheet.
ON_FLOOR = {"parquet", "tiles", "stonewall", "checks", "water", "planks", "cobbles", "grid",
            "brick", "roofing", "inlaidfloor", "ocean", "ripples", "pebbles", "wornfloor", "asphalt"}
WATERS = {"water"}
INTERIORS = {"tintedinterior"}


SEA = {"surface_color": (0.03, 0.15, 0.18), "Ks": 0.9, "roughness": 0.03, "sheen": 3.0}
# Those whose defaults suit another size of scene, or stand for a thing to be filled in.
VALUES = {
    "spotlight": {"intensity": 18.0, "coneangle": 0.42}, "pointlight": {"intensity": 14.0},
    "fog": {"distance": 16.0, "background": (0.70, 0.76, 0.82)},
    "depthcue": {"mindistance": 0.08, "maxdistance": 0.8, "background": (0.08, 0.09, 0.12)},
    "smoke": {"density": 0.10, "stepsize": 0.4, "frequency": 0.8, "smokecolor": (0.8, 0.8, 0.85)},
    "paintedplastic": {"texturename": "pattern.png"}, "bumpy": {"texturename": "pattern.png"},
    "bumpmapped": {"bumpname": "pattern.png"}, "shinymetal": {"texturename": "sky.png"}, "background": {"background": (0.15, 0.3, 0.55)},
    "planks": {"width": 0.3}, "bulblight": {"intensity": 6.0}, "ambientlight": {"intensity": 0.7},
    "ocean": SEA, "ripples": SEA, "windowlight": {"from": Point((-4.0, -1.2, 2.6)), "to": Point((0.0, 0.0, 0.4)),
                    "intensity": 1.4},
    "collada_point": {"quadratic_attenuation": 0.06}, "collada_spot": {"falloff_angle": 44.0},
}


def kind_of(code):
    """The stage of a shader file, and the shader's name: the last shader of the file."""
    bare = re.sub(r"/\*.*?\*/|//[^\n]*", " ", code, flags=re.S)
    found = re.findall(rf"\b({'|'.join(KINDS)})\s+(\w+)\s*\([^;]*", bare)
    if name := re.search(r"\bclass\s+(\w+)\s*\(", bare):
        kinds = [k for k in ("light", "volume", "displacement") if f"void {k}(" in bare]
        surface = re.search(r"void (surface|\w*lighting)\(", bare)
        return "surface" if surface or not kinds else kinds[0], name[1]
    kind, name = found[-1] if found else (None, None)
    return "transformation" if kind == "deformation" else kind, name


# Co-shaders of what is nothing without them: parameters of type shader with their handles.
LAYERS = {"layered": {"base": ("earthenware",), "layers": ["goldband", "drippedglaze", "dustfall"],
                      "pattern": ("cloudvalue",)}}


def with_layers(name, code):
    """The stages of a look with its co-shaders, and their handles."""
    values = LAYERS.get(name, {})
    used = [handle for handles in values.values() for handle in handles]
    folder = SHADERS / "classes/layer"
    return [("SURFACE", name, code)] + [((h,), h, (folder / f"{h}.sl").read_text()) for h in used], values


def joined(*meshes):
    """Several meshes as one: an object in one space."""
    positions, st, quads = [], [], []
    for p, uv, q in meshes:
        base = len(positions)
        positions += p
        st += uv
        quads += [tuple(i + base for i in quad) for quad in q]
    return positions, st, quads


def ball(radius=1.0, tilt=24.0, around=96, along=48):
    """A sphere whose upper pole leans towards the camera."""
    c, s = math.cos(math.radians(tilt)), math.sin(math.radians(tilt))

    def place(u, v):
        a, b = 2 * math.pi * u - 0.5 * math.pi, math.pi * v
        x, y, z = math.sin(b) * math.cos(a), math.sin(b) * math.sin(a), -math.cos(b)
        return radius * x, radius * (c * y - s * z), radius * (s * y + c * z)

    return grid_of(place, around, along)


def ring(major, minor, z, around=128, along=32):
    def place(u, v):
        a, b = 2 * math.pi * u - 0.5 * math.pi, 2 * math.pi * v
        r = major + minor * math.cos(b)
        return r * math.cos(a), r * math.sin(a), z + minor * math.sin(b)

    return grid_of(place, around, along)


def ball_on_ring():
    return joined(ball(), ring(0.95, 0.20, -0.733))


def backdrop(width=9.0, front=-9.0, back=3.2, bend=1.6, height=7.0):
    """Floor and wall in one sheet with a round bend between them."""
    flat, arc = back - bend - front, 0.5 * math.pi * bend
    total = flat + arc + height

    def place(s, t):
        d, x = t * total, width * (2 * s - 1)
        if d < flat:
            return x, front + d, 0.0
        if d < flat + arc:
            a = (d - flat) / bend
            return x, back - bend + bend * math.sin(a), bend - bend * math.cos(a)
        return x, back, bend + d - flat - arc

    return grid_of(place, 1, 48)


class Stage:
    def __init__(self):
        self.dae = Dae()

    def shader(self, name):
        return (SHADERS / (name + ".sl")).read_text()

    def material(self, name, stage, shader, code=None, values=None):
        self.dae.material(name, [(stage, shader.split("/")[-1], code or self.shader(shader))],
                          VALUES.get(shader, {}) if values is None else values)

    def put(self, name, mesh, material, transforms=(), flat=False):
        self.dae.mesh(name, mesh, material, flat=flat)
        self.dae.node(name, name, material, transforms)

    def lamp(self, name, shader, values, transforms, code=None):
        self.dae.light(name, shader.split("/")[-1], code or self.shader(shader), values)
        self.dae.light_node(name, transforms)

    def studio(self, floor=True, bright=1.0, wall=4.0):
        """Backdrop, a large soft key light, a cool rim light, and white cards to mirror."""
        if floor:
            self.material("backdrop", "SURFACE", "scenes/backdrop")
            self.put("backdrop", backdrop(), "backdrop")
        elif wall is not None:
            self.material("backdrop", "SURFACE", "scenes/backdrop")
            self.put("backdrop", grid_of(lambda s, t: (80 * s - 40, wall, 40 * t), 1, 1),
                     "backdrop")
        self.material("card", "SURFACE", "scenes/whitecard")
        card = grid_of(lambda s, t: (2 * s - 1, 2 * t - 1, 0), 1, 1)
        for name, eye, size in (("left", (-5.2, -4.6, 5.6), (1.7, 1.2, 1)),
                                ("right", (6.2, -2.4, 2.6), (0.7, 1.9, 1)),
                                ("top", (0.5, -1.0, 7.5), (1.8, 0.8, 1))):
            self.put("card_" + name, card, "card",
                     [("lookat", "aim", (*eye, 0, 0, 0.9, 0, 0.1, 1)), ("scale", "size", size)])
        self.lamp("key", "scenes/softspot",
                  {"intensity": 36.0 * bright, "radius": 0.35, "coneangle": 0.42,
                   "lightcolor": (1.0, 0.96, 0.9)}, [KEY])
        self.lamp("rim", "distantlight", {"intensity": 0.55 * bright,
                                          "lightcolor": (0.72, 0.84, 1.0)},
                  [("lookat", "aim", (4.5, 2.6, 3.2, 0, 0, 0.8, 0, 0, 1))])
        self.lamp("fill", "ambientlight", {"intensity": 0.2 * bright,
                                           "lightcolor": (0.95, 0.97, 1.0)}, [])

    def camera(self, eye=(0.0, -6.6, 2.5), to=(0.0, 0.0, 0.78), xfov=25.0):
        self.dae.camera("camera", xfov, 1.0, [("lookat", "view", (*eye, *to, 0, 0, 1))])

    def props(self):
        """Painted things of several colours to fall light on."""
        for name, colour in (("red", (0.7, 0.12, 0.08)), ("blue", (0.1, 0.22, 0.55)),
                             ("ochre", (0.75, 0.52, 0.16)), ("white", (0.8, 0.8, 0.78))):
            self.material(name, "SURFACE", "plastic",
                          values={"surface_color": colour, "Kd": 0.9, "Ks": 0.3})
        self.put("globe", ball(0.55), "red", [("translate", "place", (-0.75, 0.1, 0.55))])
        self.put("pillar", lathe_of(lambda t: (0.32 - 0.08 * math.sin(3 * t), 1.5 * t), 64, 16),
                 "white", [("translate", "place", (0.35, 0.75, 0))])
        self.put("hoop", ring(0.42, 0.14, 0.14), "ochre",
                 [("translate", "place", (0.05, -0.85, 0))])
        add_box(self.dae, "cube", "blue", (-0.4, -0.4, 0), (0.4, 0.4, 0.8),
                [("translate", "place", (1.05, -0.2, 0)), ("rotate", "turn", (0, 0, 1, 28))])


def surface(name, code):
    stage = Stage()
    stages, handles = with_layers(name, code)
    stage.dae.material("shown", stages, VALUES.get(name, {}) | handles)
    on_floor = name in ON_FLOOR
    stage.studio(floor=not on_floor)
    if on_floor:
        stage.put("floor", grid_of(lambda s, t: (6 * s - 3, 6 * t - 2, 0), 1, 1), "shown",
                  flat=True)
        if name in WATERS:
            stage.material("buoy", "SURFACE", "plastic", values={"surface_color": (0.8, 0.2, 0.05)})
            stage.put("buoy", ball(0.8), "buoy", [("translate", "place", (0, 0, 0.3))])
        else:
            add_box(stage.dae, "block", "shown", (-0.6, -0.6, 0), (0.6, 0.6, 1.2),
                    [("rotate", "turn", (0, 0, 1, 35))])
        stage.camera(xfov=27.0)
    else:
        stage.put("shown", ball_on_ring(), "shown", [("translate", "place", (0, 0, 0.933))])
        stage.camera()
    return stage


def leaf(name, code):
    """A heap of cards that fell on the floor, of which the shader leaves the leaves."""
    stage = Stage()
    stage.material("shown", "SURFACE", name, code, {})
    stage.studio()
    for k in range(70):
        angle, out = 2.399963 * k, 1.35 * math.sqrt((k + 0.5) / 70)
        place = (out * math.cos(angle), out * math.sin(angle) - 0.1, 0.1 + 0.9 * math.exp(-1.6 * out * out) + 0.012 * k)
        stage.put(f"card{k}", grid_of(lambda s, t: (0.8 * s - 0.4, t - 0.5, 0.10 * math.sin(3 * t + k)), 8, 8),
                  "shown", [("translate", "place", place),
                            ("rotate", "turn", (0, 0, 1, math.degrees(angle) + 31 * (k % 7))),
                            ("rotate", "lean", (1, 0.3 * (k % 3 - 1), 0, 18 + 9 * (k % 5)))])
    stage.camera()
    return stage


def displacement(name, code):
    stage = Stage()
    plain = stage.shader("scenes/porcelain")
    stage.dae.material("shown", [("DISPLACEMENT", name, code), ("SURFACE", "porcelain", plain)],
                       VALUES.get(name, {}))
    on_floor = name in ON_FLOOR
    stage.studio(floor=not on_floor)
    if on_floor:
        stage.put("floor", grid_of(lambda s, t: (6 * s - 3, 6 * t - 2, 0), 60, 60), "shown")
    else:
        stage.put("shown", ball_on_ring(), "shown", [("translate", "place", (0, 0, 0.933))])
    stage.camera()
    return stage


def transformation(name, code):
    stage = Stage()
    stage.dae.material("shown", [("TRANSFORMATION", name, code),
                                 ("SURFACE", "checks", stage.shader("surface/checks"))], {})
    stage.studio()
    stage.put("shown", ball_on_ring(), "shown", [("translate", "place", (0, 0, 0.933))])
    stage.camera()
    return stage


def light(name, code):
    """The shader is the only light but for a little ambient; it looks down from the left."""
    stage = Stage()
    stage.material("backdrop", "SURFACE", "scenes/backdrop")
    stage.put("backdrop", backdrop(), "backdrop")
    stage.props()
    stage.lamp("shown", name, VALUES.get(name, {}),
               [("lookat", "aim", (-1.9, -2.2, 3.2, 0.1, 0, 0.35, 0, 0, 1))], code)
    stage.lamp("fill", "ambientlight", {"intensity": 0.06}, [])
    stage.camera()
    return stage


def with_effect(stage, kind, name, code):
    """The shader becomes the scene's atmosphere or imager."""
    stage.dae.effect("shown", [(kind, name, code)], VALUES.get(name, {}))
    stage.dae.scene_extra = ('<extra><technique profile="RSL"><instance_effect '
                             'url="#shown-effect"/></technique></extra>')
    return stage


def interior(name, code):
    """A clear body filled with the volume."""
    stage = Stage()
    stage.dae.material("shown", [("SURFACE", "bulbglass", stage.shader("scenes/bulbglass")),
                                 ("VOLUME", name, code)], {})
    stage.studio()
    stage.put("shown", ball_on_ring(), "shown", [("translate", "place", (0, 0, 0.933))])
    stage.camera()
    return stage


def volume(name, code):
    """A colonnade that goes away from the camera."""
    if name in INTERIORS:
        return interior(name, code)
    stage = Stage()
    stage.studio(floor=False, wall=34.0)
    stage.material("stone", "SURFACE", "scenes/backdrop")
    stage.material("red", "SURFACE", "plastic", values={"surface_color": (0.65, 0.1, 0.06),
                                                        "Kd": 0.9, "Ks": 0.3})
    stage.put("floor", grid_of(lambda s, t: (24 * s - 12, 40 * t - 6, 0), 1, 1), "stone")
    for row in range(8):
        for side in (-1, 1):
            name_of = f"pillar{row}{side + 1}"
            stage.put(name_of, lathe_of(lambda t: (0.34, 3.0 * t), 32, 2), "stone",
                      [("translate", "place", (side * 1.15, 2.6 * row - 1, 0))])
    stage.put("globe", ball(0.5), "red", [("translate", "place", (0.1, -0.4, 0.5))])
    stage.camera(xfov=34.0, to=(0.0, 0.0, 1.1))
    return with_effect(stage, "VOLUME", name, code)


def imager(name, code):
    stage = Stage()
    stage.studio(floor=name != "background", wall=None)
    stage.props()
    stage.camera()
    return with_effect(stage, "IMAGER", name, code)


def pictures(folder):
    """The images that VALUES names: a pattern of leaves, and a sky with a sun."""
    def pattern(x, y):
        a, r = math.atan2(y, x), math.hypot(x, y)
        leaf = 0.55 + 0.35 * math.cos(6 * a)
        k = max(0.0, min(1.0, (leaf - r) * 12 + 0.5)) * (0.6 + 0.4 * math.cos(18 * r))
        return 40 + 200 * k, 70 + 120 * k, 130 - 90 * k

    def sky(x, y):
        up = -y
        sun = math.exp(-40 * ((x + 0.3) ** 2 + (up - 0.45) ** 2))
        if up > 0:
            return [min(255, c + 600 * sun) for c in (120 - 60 * up, 160 - 40 * up, 225 - 20 * up)]
        return 84 + 40 * up, 66 + 30 * up, 48 + 20 * up

    for name, colour, width in (("pattern", pattern, 128), ("sky", sky, 256)):
        rows = [bytes(int(max(0, c)) for i in range(width)
                      for c in colour(2 * (i + 0.5) / width - 1, 2 * (j + 0.5) / 128 - 1))
                for j in range(128)]
        png.write(folder / f"{name}.png", width, 128, rows)


def scene_for(path):
    """The stage of a shader file."""
    code = path.read_text()
    kind, name = kind_of(code)
    if kind is None:
        raise ValueError(f"{path}: no shader found")
    return globals()["leaf" if path.parent.name == "leaf" else kind](name, code)
