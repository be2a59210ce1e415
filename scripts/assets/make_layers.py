# scripts/assets/make_layers.py: four pots of one class shader, which finds its layers by handles:
# body, glaze, speckles, cracks, gilt bands and dust are co-shaders, a library of the scene.
#
#   make_layers.py OUT.dae
import math
import sys

from dae_writer import Dae, grid_of, lathe_of, smooth

POT = """/* A pot: the body and each layer above it change tint, shine and rise in turn. */
class pot(shader body = null; shader layers[] = {}; float relief = 0.05;) {
    varying color tint = 0.5;
    varying float shine = 0, rise = 0;

    public void begin() {
        uniform float i;
        if (body != null) body->lay(tint, shine, rise);
        for (i = 0; i < arraylength(layers); i += 1) layers[i]->lay(tint, shine, rise);
    }
    public void displacement(output point P; output normal N) {
        vector rounding = normalize(N) - normalize(Ng);  /* the facets are to look smooth */
        P += relief * rise * normalize(N);
        N = normalize(calculatenormal(P)) + rounding;
    }
    public void surface(output color Ci, Oi) {
        normal Nf = faceforward(normalize(N), I);
        vector V = -normalize(I);
        float fresnel = 0.04 + 0.96 * pow(1 - abs(Nf . V), 5);
        color coat = specular(Nf, V, mix(0.3, 0.04, shine)) + fresnel * color trace(P, reflect(-V, Nf));
        Ci = tint * (ambient() + diffuse(Nf)) + shine * coat;
        Oi = 1;
    }
}
"""

LIBRARY = {
    "clay": ("""/* Thrown clay: grain, and the rings that fingers left. */
class clay(color tone = color(0.55, 0.27, 0.14); float grain = 0.3; float rings = 34;) {
    public void lay(output color tint; output float shine, rise;) {
        point Q = transform("object", P);
        float dots = float noise(18 * Q) * 0.5 + float noise(55 * Q) * 0.5;
        tint = tone * mix(1 - grain, 1 + grain, dots);
        rise = 0.12 * sin(rings * PI * t + 2 * float noise(2 * Q)) + 0.1 * dots;
        shine = 0;
    }
}
""", {}),
    "celadon": ("""/* A glaze that has run: thick and dark where it pooled, bare below its lower edge. */
class runglaze(color thin = color(0.62, 0.78, 0.66); color deep = color(0.12, 0.36, 0.32); float edge = 0.24;) {
    public void lay(output color tint; output float shine, rise;) {
        point Q = transform("object", P);
        float drip = 0.16 * float noise(6 * s, 1) + 0.05 * float noise(23 * s, 5);
        float covers = smoothstep(0, 0.012, t - edge + drip);
        float pool = 0.6 * float noise(1.7 * Q) + 0.5 * smoothstep(0.2, 0, t - edge + drip);
        tint = mix(tint, mix(thin, deep, smoothstep(0.25, 0.8, pool)), covers);
        rise = mix(rise, 0.3 * rise + 0.5 * pool, covers);
        shine = mix(shine, 1, covers);
    }
}
""", {}),
    "cobalt": ("runglaze", {"thin": (0.16, 0.27, 0.62), "deep": (0.02, 0.04, 0.2), "edge": 0.36}),
    "tenmoku": ("runglaze", {"thin": (0.42, 0.13, 0.03), "deep": (0.03, 0.02, 0.02), "edge": 0.3}),
    "speckles": ("""/* Iron specks that burnt through. */
class specks(color iron = color(0.12, 0.07, 0.04); float scale = 22; float amount = 0.3;) {
    public void lay(output color tint; output float shine, rise;) {
        point Q = scale * transform("object", P);
        point cell = point(floor(Q[0]), floor(Q[1]), floor(Q[2]));
        float there = step(1 - amount, float cellnoise(cell));
        point at = cell + vector(0.5, 0.5, 0.5) + 0.5 * (vector cellnoise(cell) - vector(0.5, 0.5, 0.5));
        float speck = there * (1 - smoothstep(0.14, 0.26, distance(Q, at)));
        tint = mix(tint, iron, 0.85 * speck);
        shine *= 1 - 0.5 * speck;
    }
}
""", {}),
    "gilt": ("""/* Gold leaf in bands, worn through in places. */
class bands(color gold = color(0.95, 0.62, 0.2); float low = 0.6; float high = 0.66; float wear = 0.35;) {
    public void lay(output color tint; output float shine, rise;) {
        point Q = transform("object", P);
        float band = smoothstep(low, low + 0.004, t) * (1 - smoothstep(high, high + 0.004, t));
        float zigzag = abs(2 * mod(14 * s, 1) - 1) * (high - low) + low;
        band = max(band * smoothstep(0.004, 0.008, abs(t - zigzag)), step(0.97, t));
        band *= smoothstep(wear - 0.1, wear + 0.05, float noise(9 * Q) * 0.7 + float noise(31 * Q) * 0.3);
        tint = mix(tint, gold, band);
        shine = mix(shine, 1.2, band);
        rise += 0.08 * band;
    }
}
""", {}),
    "dust": ("""/* Dust lies where the surface looks up. */
class settled(color grey = color(0.5, 0.46, 0.4); float amount = 0.5;) {
    public void lay(output color tint; output float shine, rise;) {
        normal up = normalize(ntransform("world", N));
        float lies = amount * smoothstep(0.15, 0.9, up[2]) * (0.6 + 0.4 * float noise(40 * transform("object", P)));
        tint = mix(tint, grey, lies);
        shine *= 1 - lies;
    }
}
""", {}),
}

# pot: place, radius, height, handles of the layers
POTS = {
    "jar": ((-3.0, 0.2), 1.0, 2.3, ["celadon", "speckles", "gilt"]),
    "bottle": ((-0.75, 0.9), 0.85, 3.0, ["cobalt", "gilt"]),
    "bowl": ((0.95, -0.9), 1.05, 1.2, ["tenmoku", "speckles"]),
    "vase": ((2.9, 0.3), 0.95, 2.6, ["celadon", "dust"]),
}
PROFILES = {
    "jar": [0.0, 0.55, 0.62, 0.9, 1.0, 0.95, 0.6, 0.55, 0.66],
    "bottle": [0.0, 0.6, 0.75, 1.0, 0.85, 0.4, 0.24, 0.22, 0.36],
    "bowl": [0.0, 0.45, 0.5, 0.72, 0.86, 0.94, 0.99, 1.0, 1.02],
    "vase": [0.0, 0.5, 0.55, 0.75, 0.95, 1.0, 0.8, 0.55, 0.85],
}
TABLE = """surface table(color wood = color(0.3, 0.17, 0.09);) {
    point Q = transform("object", P);
    float plank = floor(0.9 * ycomp(Q));
    float fibre = float noise(1.2 * xcomp(Q) + 9 * plank, 14 * ycomp(Q)) * 0.6 + float noise(4 * xcomp(Q), 60 * ycomp(Q)) * 0.4;
    float gap = smoothstep(0, 0.03, mod(0.9 * ycomp(Q), 1)) * (1 - smoothstep(0.97, 1, mod(0.9 * ycomp(Q), 1)));
    normal Nf = faceforward(normalize(N), I);
    Ci = wood * mix(0.65, 1.25, fibre) * mix(0.8, 1.1, cellnoise(plank)) * mix(0.35, 1, gap) * (ambient() + diffuse(Nf));
    Oi = 1;
}
"""
LIGHT = """light lamp(float intensity = 1; color lightcolor = 1;) {
    solar(vector "shader" (0, 0, 1), 0) Cl = intensity * lightcolor;
}
"""


def outline(name, radius, height):
    def at(t):
        if t < 0.06:
            return radius * PROFILES[name][1] * t / 0.06, 0.0
        along = (t - 0.06) / 0.94
        return radius * smooth(PROFILES[name][1:], along), height * along

    return lathe_of(at, 32, 32)


def library(dae):
    """The effect that the scene's <extra> names."""
    codes, shaders, params, classes = "", "", "", {}
    for handle, (code, values) in LIBRARY.items():
        if "class" in code:
            name = code.split("class ")[1].split("(")[0]
            codes += code
            classes[name] = code
        else:
            name = code
        binds = ""
        for k, v in values.items():
            params += f'<newparam sid="{handle}-{k}">{dae.value(v)}</newparam>\n'
            binds += f'<bind symbol="{k}"><param ref="{handle}-{k}"/></bind>'
        shaders += f'<shader stage="COSHADER" handle="{handle}"><name>{name}</name>{binds}</shader>\n'
    dae.parts["effects"].append(
        f'<effect id="glazes">{params}<profile_RSL><technique sid="default">\n<code><![CDATA[\n{codes}]]></code>\n'
        f"<pass>\n{shaders}</pass></technique></profile_RSL></effect>")
    dae.scene_extra = ('<extra><technique profile="RSL"><instance_effect url="#glazes"/></technique></extra>\n')


def pots(dae):
    binds = "".join(f'<bind symbol="{k}"><param ref="{k}"/></bind>' for k in ("body", "layers", "relief"))
    dae.parts["effects"].append(
        '<effect id="pot-effect"><profile_RSL><newparam sid="body"><string>clay</string></newparam>\n'
        '<newparam sid="layers"><string>celadon</string></newparam>\n<newparam sid="relief"><float>0.05</float></newparam>\n'
        f'<technique sid="default"><code><![CDATA[\n{POT}]]></code>\n<pass><shader stage="SURFACE"><name>pot</name>{binds}'
        '</shader></pass></technique></profile_RSL></effect>')
    for name, (place, radius, height, layers) in POTS.items():
        items = ", ".join(layers)
        dae.parts["materials"].append(
            f'<material id="{name}-material"><instance_effect url="#pot-effect"><setparam ref="layers"><string>{items}</string>'
            "</setparam></instance_effect></material>")
        dae.mesh(name, outline(name, radius, height), name)
        dae.node(name, name, name, [("translate", "place", (*place, 0.0))])


def main(path):
    dae = Dae()
    library(dae)
    pots(dae)
    dae.material("table", [("SURFACE", "table", TABLE)], {})
    dae.mesh("table", grid_of(lambda s, t: ((2 * s - 1) * 14, (2 * t - 1) * 14, 0), 1, 1), "table")
    dae.node("table", "table", "table")
    for name, values in (("key", {"intensity": 1.15, "lightcolor": (1.0, 0.9, 0.76)}),
                         ("fill", {"intensity": 0.4, "lightcolor": (0.6, 0.75, 1.0)})):
        dae.light(name, "lamp", LIGHT, values)
    dae.light_node("key", [("lookat", "aim", (-5, -4, 6, 0, 0, 0, 0, 0, 1))])
    dae.light_node("fill", [("lookat", "aim", (6, -5, 3, 0, 0, 1, 0, 0, 1))])
    dae.camera("camera", 40.0, 16 / 9, [("lookat", "view", (0, -10.5, 4.2, 0, 0, 1.05, 0, 0, 1))])
    dae.write(path)


main(*sys.argv[1:])
