# scripts/assets/make_atelier.py: a studio under a sky of its own: vessels on a turning stand, an easel, two
# softboxes and a bulb that swings. One class has all materials; co-shaders paint it.
#
#   make_atelier.py OUT.dae    writes the picture of the sky beside it
import math
import sys
from pathlib import Path

from dae_writer import Dae, add_box, grid_of, lathe_of, smooth

FRAMES, RATE = 96, 24
SKY = (128, 64)  # pixels of latitudes and longitudes

MATERIAL = """/* Two lobes: Lambert and microfacets (B. Walter and others 2007, GGX). directlighting() weighs what the
   lamps and the facets choose, indirectspecular() and indirectdiffuse() bring the rest. A co-shader paints.
   Parameters: tint, rough, metal, samples (of the facets), paint. */
class atelier(color tint = 0.5; float rough = 0.3; float metal = 0; uniform float samples = 4;
              shader paint = null;) {
    varying normal Nn = 0;
    varying vector Vn = 0, Tn = 0, Bn = 0;
    varying color matte = 0, shine = 0;
    varying float width = 0.1;

    public void begin() {
        Nn = normalize(faceforward(N, I));
        Vn = -normalize(I);
        Tn = normalize(abs(Nn[0]) < 0.9 ? Nn ^ vector(1, 0, 0) : Nn ^ vector(0, 1, 0));
        Bn = Nn ^ Tn;
    }
    public void prelighting(output color Ci, Oi) {
        color c = tint;
        float r = rough;
        if (paint != null) paint->colour(c, r);
        width = max(0.02, r * r);
        shine = mix(color(0.04, 0.04, 0.04), c, metal);
        matte = (1 - metal) * c;
    }
    float shadowing(float c) { return 2 * c / (c + sqrt(width * width + (1 - width * width) * c * c)); }
    void facets(vector Ln; output color response; output float pdf;) {
        vector H = normalize(Ln + Vn);
        float nl = Ln . Nn, nv = Vn . Nn, nh = H . Nn, vh = H . Vn;
        response = 0;
        pdf = 0;
        if (nv > 0 && nh > 0 && vh > 0) {
            float k = nh * nh * (width * width - 1) + 1, d = width * width / (PI * k * k);
            pdf = d * nh / (4 * vh);
            if (nl > 0)
                response = (shine + (1 - shine) * pow(1 - vh, 5)) * d * shadowing(nl) * shadowing(nv) / (4 * nv);
        }
    }
    public void evaluateSamples(string what; output __radiancesample s[]) {
        uniform float i;
        color response = 0;
        float pdf = 0;
        for (i = 0; i < arraylength(s); i += 1) {
            if (what == "diffuse") {
                s[i]->setMaterialResponse(matte * max(0, s[i]->direction . Nn) / PI, 0);
            } else {
                facets(s[i]->direction, response, pdf);
                s[i]->setMaterialResponse(response, pdf);
            }
        }
    }
    public void generateSamples(string what; output __radiancesample s[]) {
        uniform float i, most = samples;
        rayinfo("samplelimit", most);  /* behind rays of many one is enough */
        uniform float start = arraylength(s), end = start + min(samples, most);
        color response = 0;
        float pdf = 0;
        if (what == "specular" || what == "indirectspecular") {
            resize(s, end);
            for (i = start; i < end; i += 1) {
                float x = random(), a = 2 * PI * random();
                float c = sqrt((1 - x) / (1 + (width * width - 1) * x));
                vector H = (Tn * cos(a) + Bn * sin(a)) * sqrt(max(0, 1 - c * c)) + Nn * c;
                vector Ln = 2 * (H . Vn) * H - Vn;
                facets(Ln, response, pdf);
                s[i]->setMaterialSample(response, pdf, Ln, 1e30);
            }
        }
    }
    public void lighting(output color Ci, Oi) {
        color dull = 0, gloss = 0;
        directlighting(this, getlights(), "mis", 1, "diffuseresult", dull, "specularresult", gloss);
        gloss += indirectspecular(this);
        dull += matte * indirectdiffuse(P, Nn, samples);
        Ci = dull + gloss;
        Oi = 1;
    }
}
"""

PAINTS = {
    "planks": """/* Boards along y, a little worn. */
class planks(color wood = color(0.42, 0.27, 0.15);) {
    public void colour(output color tint; output float rough;) {
        point Q = transform("object", P);
        float x = 1.1 * Q[0], board = floor(x), across = mod(x, 1);
        float fibre = 0.6 * noise(14 * Q[0], 0.8 * Q[1] + 9 * cellnoise(board)) + 0.4 * noise(60 * Q[0], 3 * Q[1]);
        float gap = smoothstep(0, 0.025, across) * (1 - smoothstep(0.975, 1, across));
        tint = wood * mix(0.6, 1.25, fibre) * mix(0.75, 1.1, cellnoise(board + 3)) * mix(0.25, 1, gap);
        rough = mix(0.75, mix(0.34, 0.5, fibre), gap);
    }
}
""",
    "plaster": """/* A wall that many coats have made uneven. */
class plaster(color lime = color(0.78, 0.75, 0.69);) {
    public void colour(output color tint; output float rough;) {
        point Q = transform("object", P);
        tint = lime * mix(0.86, 1.05, 0.6 * noise(1.3 * Q) + 0.4 * noise(7 * Q));
        rough = 0.8;
    }
}
""",
    "runs": """/* A glaze that has run and pooled over clay. */
class runs(color thin = color(0.75, 0.83, 0.74); color deep = color(0.08, 0.32, 0.36);
           color clay = color(0.46, 0.26, 0.16);) {
    public void colour(output color tint; output float rough;) {
        point Q = transform("object", P);
        float drip = 0.2 * noise(7 * s, 1) + 0.06 * noise(23 * s, 5);
        float covers = smoothstep(0, 0.01, t - 0.22 + drip);
        float pool = 0.7 * noise(1.9 * Q) + 0.5 * smoothstep(0.25, 0, t - 0.22 + drip);
        tint = mix(clay * mix(0.8, 1.1, noise(20 * Q)), mix(thin, deep, smoothstep(0.25, 0.8, pool)), covers);
        rough = mix(0.7, 0.16, covers);
    }
}
""",
    "hills": """/* What stands on the easel: evening hills in flat paint. */
class hills() {
    public void colour(output color tint; output float rough;) {
        float k;
        tint = mix(color(0.95, 0.62, 0.35), color(0.3, 0.36, 0.55), smoothstep(0.3, 1, t));
        float sun = 1 - smoothstep(0.085, 0.09, sqrt((s - 0.66) * (s - 0.66) * 1.6 + (t - 0.56) * (t - 0.56)));
        tint = mix(tint, color(1, 0.86, 0.6), sun);
        for (k = 0; k < 4; k += 1) {
            float ridge = 0.52 - 0.12 * k + 0.13 * (noise((3 + k) * s + 7 * k, 3) - 0.5) + 0.02 * noise(30 * s, k);
            color paint = mix(color(0.5, 0.4, 0.5), color(0.06, 0.12, 0.1), k / 3);
            tint = mix(tint, paint * mix(0.9, 1.1, noise(60 * s, 60 * t)), 1 - smoothstep(ridge - 0.004, ridge + 0.004, t));
        }
        rough = 0.55 + 0.2 * noise(90 * s, 25 * t);
    }
}
""",
}

SOFTBOX = """/* A cloth over lamps: `power` is its radiance, `area` that of the mesh. */
light softbox(float power = 1; float area = 1; color lightcolor = 1;) {
    illuminate(P, N, PI / 2)
        Cl = power * lightcolor * area / PI * max(0, normalize(L) . normalize(N)) / (L . L);
}
"""
BULB = """/* A ball of light, sampled within the cone that it fills. */
class bulb(float power = 60; float radius = 0.22; color lightcolor = color(1, 0.72, 0.42);
           uniform float samples = 4;) {
    public void generateSamples(string what; output __radiancesample s[]) {
        point centre = point "shader" (0, 0, 0);
        vector to = centre - Ps;
        float far = length(to);
        vector W = to / far, U = normalize(abs(W[0]) < 0.9 ? W ^ vector(1, 0, 0) : W ^ vector(0, 1, 0)), V = W ^ U;
        uniform float i;
        resize(s, samples);
        float ratio = min(0.999, radius / far), least = sqrt(1 - ratio * ratio);
        for (i = 0; i < samples; i += 1) {
            float c = mix(least, 1, random()), a = 2 * PI * random(), q = sqrt(max(0, 1 - c * c));
            vector D = W * c + (U * cos(a) + V * sin(a)) * q;
            float near = far * c - sqrt(max(0, radius * radius - far * far * q * q));
            s[i]->setLightSample(power * lightcolor, 1 / (2 * PI * (1 - least)), D, near);
        }
    }
    public void evaluateSamples(string what; output __radiancesample s[]) {
        point centre = point "shader" (0, 0, 0);
        vector to = centre - Ps;
        float far = length(to), ratio = min(0.999, radius / far), least = sqrt(1 - ratio * ratio);
        uniform float i;
        for (i = 0; i < arraylength(s); i += 1) {
            float c = normalize(s[i]->direction) . to / far;
            if (c > least) {
                s[i]->setLightSample(power * lightcolor, 1 / (2 * PI * (1 - least)));
                s[i]->distance = far * c - sqrt(max(0, radius * radius - far * far * (1 - c * c)));
            } else {
                s[i]->setLightSample(0, 0);
            }
        }
    }
}
"""
GLOW = "surface glow(color shows = 1;) { Oi = 1; Ci = shows; }\n"

PROFILES = {
    "jar": [0.0, 0.55, 0.62, 0.9, 1.0, 0.95, 0.6, 0.55, 0.66],
    "bottle": [0.0, 0.6, 0.75, 1.0, 0.85, 0.4, 0.24, 0.22, 0.36],
    "bowl": [0.0, 0.4, 0.45, 0.75, 0.9, 0.98, 1.0],
}


def sky(path):
    """A clear sky with a low sun behind thin cloud, as a Radiance picture: 4 bytes a pixel, not packed."""
    width, height = SKY
    rows = bytearray()
    sun = (math.radians(-62), math.radians(34))
    for y in range(height):
        elevation = math.pi / 2 - (y + 0.5) / height * math.pi
        for x in range(width):
            turn = (x + 0.5) / width * 2 * math.pi - math.pi
            cosine = (math.sin(elevation) * math.sin(sun[1])
                      + math.cos(elevation) * math.cos(sun[1]) * math.cos(turn - sun[0]))
            away = math.acos(max(-1.0, min(1.0, cosine)))
            up = max(0.0, math.sin(elevation))
            haze = math.exp(-4 * up)
            color = [0.16 + 0.5 * haze, 0.28 + 0.42 * haze, 0.55 + 0.3 * haze]
            if elevation < 0:
                color = [0.16, 0.14, 0.12]
            glow = 55 * math.exp(-((away / 0.055) ** 2)) + 1.6 * math.exp(-away / 0.3)
            if elevation > -0.02:
                color = [c + g * glow for c, g in zip(color, (1.0, 0.82, 0.58))]
            most = max(color)
            mantissa, exponent = math.frexp(most)
            scale = mantissa * 256 / most
            rows += bytes([int(c * scale) for c in color] + [exponent + 128])
    path.write_bytes(f"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {height} +X {width}\n".encode() + rows)


def vessel(name, radius, height):
    return lathe_of(lambda t: (radius * max(0.0, smooth(PROFILES[name], t)), height * max(0.0, (t - 0.06) / 0.94)),
                    48, 40)


def painted(dae, name, values, paint=None):
    stages = [("SURFACE", "atelier", MATERIAL)]
    if paint:
        stages.append(((paint,), paint, PAINTS[paint]))
        values = {**values, "paint": (paint,)}
    dae.material(name, stages, values)


def room(dae):
    painted(dae, "floor", {"rough": 0.4}, "planks")
    painted(dae, "wall", {"rough": 0.8}, "plaster")
    painted(dae, "wood", {"tint": (0.3, 0.17, 0.09), "rough": 0.45})
    painted(dae, "canvas", {}, "hills")
    dae.mesh("floor", grid_of(lambda s, t: (20 * s - 10, 16 * t - 8, 0), 1, 1), "floor")
    dae.node("floor", "floor", "floor")
    for name, place in (("back", lambda s, t: (20 * s - 10, 5, 9 * t)), ("side", lambda s, t: (8, 5 - 13 * s, 9 * t))):
        dae.mesh(name, grid_of(place, 1, 1), "wall")
        dae.node(name, name, "wall")


def easel(dae):
    with dae.group("easel", [("translate", "place", (3.6, 2.6, 0)), ("rotate", "turn", (0, 0, 1, -28))]):
        for name, x, turn in (("left-leg", -1.1, 7), ("right-leg", 1.1, -7)):
            add_box(dae, name, "wood", (-0.09, -0.09, 0), (0.09, 0.09, 6.2),
                    [("translate", "at", (x, 0, 0)), ("rotate", "lean", (0, 1, 0, turn)),
                     ("rotate", "back", (1, 0, 0, -8))])
        add_box(dae, "hind-leg", "wood", (-0.08, -0.08, 0), (0.08, 0.08, 6),
                [("translate", "at", (0, 2, 0)), ("rotate", "back", (1, 0, 0, 12))])
        add_box(dae, "ledge", "wood", (-1.6, -0.35, 1.75), (1.6, 0.1, 1.9))
        with dae.group("leaning", [("translate", "at", (0, -0.1, 1.9)), ("rotate", "back", (1, 0, 0, -8))]):
            add_box(dae, "frame", "wood", (-1.5, 0, 0), (1.5, 0.08, 2.2))
            dae.mesh("picture", grid_of(lambda s, t: (2.8 * s - 1.4, -0.02, 0.1 + 2 * t), 1, 1), "canvas")
            dae.node("picture", "picture", "canvas")


def vessels(dae):
    painted(dae, "glazed", {}, "runs")
    painted(dae, "brass", {"tint": (0.86, 0.62, 0.26), "rough": 0.28, "metal": 1.0})
    painted(dae, "lacquer", {"tint": (0.5, 0.02, 0.03), "rough": 0.13})
    painted(dae, "steel", {"tint": (0.62, 0.63, 0.65), "rough": 0.42, "metal": 1.0})
    dae.mesh("stand", lathe_of(lambda t: smooth_stand(t), 64, 24), "steel", flat=False)
    with dae.group("turntable", [("translate", "place", (-0.9, 0.4, 0)), ("rotate", "spin", (0, 0, 1, 0))]):
        dae.node("stand", "stand", "steel")
        for name, material, shape, place, radius, height in (
                ("jar", "glazed", "jar", (-1.05, 0.45, 1.6), 0.85, 1.9),
                ("bottle", "lacquer", "bottle", (0.75, 0.8, 1.6), 0.62, 2.5),
                ("bowl", "brass", "bowl", (0.35, -0.95, 1.6), 0.8, 0.85)):
            dae.mesh(name, vessel(shape, radius, height), material)
            dae.node(name, name, material, [("translate", "place", place)])


def smooth_stand(t):
    """A round top on a foot: radius and height."""
    points = [(0.0, 1.6), (2.05, 1.6), (2.1, 1.55), (2.1, 1.45), (2.05, 1.4), (0.45, 1.36), (0.35, 1.2), (0.35, 0.3),
              (0.5, 0.15), (1.3, 0.08), (1.35, 0.0)][::-1]
    at = t * (len(points) - 1)
    k = min(int(at), len(points) - 2)
    f = at - k
    return tuple(a + (b - a) * f for a, b in zip(points[k], points[k + 1]))


def lamps(dae):
    for name, size, values, transforms in (
            ("key", (2.4, 1.6), {"power": 5.0, "lightcolor": (1.0, 0.94, 0.84)},
             [("translate", "place", (-5.2, -2.2, 5.4)), ("rotate", "turn", (0, 0, 1, 25)), ("rotate", "tip", (0, 1, 0, 128))]),
            ("rim", (0.5, 3.2), {"power": 7.0, "lightcolor": (0.62, 0.78, 1.0)},
             [("translate", "place", (1.6, 4.2, 4.6)), ("rotate", "tip", (1, 0, 0, 125))])):
        values = {**values, "area": size[0] * size[1]}
        dae.material(name, [("LIGHT", "softbox", SOFTBOX)], values)
        dae.mesh(name, grid_of(lambda s, t, size=size: ((s - 0.5) * size[0], (t - 0.5) * size[1], 0), 1, 1), name)
        dae.node(name, name, name, transforms)
    dae.light("bulb", "bulb", BULB, {"power": 42.0, "radius": 0.16})
    dae.material("shows", [("SURFACE", "glow", GLOW)], {"shows": (3.0, 2.2, 1.3)})
    dae.mesh("ball", lathe_of(lambda t: (0.158 * math.sin(math.pi * t), -0.158 * math.cos(math.pi * t)), 24, 12), "shows")
    with dae.group("cord", [("translate", "place", (2.1, 0.2, 7.6)), ("rotate", "swing", (0, 1, 0, 0))]):
        add_box(dae, "wire", "wood", (-0.02, -0.02, -2.7), (0.02, 0.02, 0))
        dae.node("ball", "ball", "shows", [("translate", "place", (0, 0, -2.86))])
        dae.light_node("bulb", [("translate", "place", (0, 0, -2.86))])


def motion(dae):
    seconds = FRAMES / RATE
    dae.channel("turntable/spin.ANGLE", [0, seconds], [0.0, 360.0])
    times = [k * seconds / 24 for k in range(25)]
    dae.channel("cord/swing.ANGLE", times, [11 * math.sin(2 * math.pi * t / seconds * 2) for t in times])


def main(path):
    picture = Path(path).with_name("atelier_sky.hdr")
    sky(picture)
    dae = Dae()
    dae.parts["images"] = [f'<image id="sky"><init_from>{picture.name}</init_from></image>']
    room(dae)
    easel(dae)
    vessels(dae)
    lamps(dae)
    motion(dae)
    dae.camera("camera", 46.0, 16 / 9, [("lookat", "view", (-1.2, -9.6, 3.9, 0.5, 0.6, 2.35, 0, 0, 1))])
    dae.scene_extra = ('<extra><technique profile="RSL"><environment><instance_image url="#sky"/><brightness>0.5</brightness>'
                       "</environment></technique></extra>\n")
    dae.write(path)


if __name__ == "__main__":
    main(*sys.argv[1:])
