/* inlaidfloor.sl: stone inlay: squares, diamonds and a border, each a struct that knows its stone.
   Parameters: tiles, joint, light, dark, accent. */
struct Stone {
    color tint = 0;
    float veins = 1;
    void choose(color c; float v) {
        tint = c;
        veins = v;
    }
    color polished(point Q) {
        float k, sum = 0;
        for (k = 1; k <= 4; k += 1) sum += abs(2 * float noise(Q * pow(2, k)) - 1) / pow(2, k);
        float vein = pow(1 - sum, 9);
        return tint * mix(0.85, 1.1, sum) + veins * 0.3 * vein;
    }
}
class inlaidfloor(float tiles = 6; float joint = 0.012; color light = color(0.82, 0.78, 0.7);
                  color dark = color(0.07, 0.09, 0.08); color accent = color(0.42, 0.1, 0.06);) {
    Stone stone;
    varying float gap = 0;

    public void begin() {
        float ss = tiles * s, tt = tiles * t;
        float x = abs(2 * mod(ss, 1) - 1), y = abs(2 * mod(tt, 1) - 1);
        float diamond = x + y - 0.62, corner = 1.62 - x - y;
        stone->choose(light, 0.3);
        if (mod(floor(ss) + floor(tt), 2) == 0) stone->choose(light * color(0.86, 0.8, 0.74), 0.4);
        if (diamond < 0) stone->choose(dark, 1);
        if (corner < 0.22) stone->choose(accent, 0.6);
        gap = min(min(abs(diamond), abs(corner - 0.22)), min(1 - x, 1 - y));
        gap = 1 - smoothstep(joint, 2.2 * joint, gap);
    }
    public void displacement(output point P; output normal N) {
        P -= 0.004 * gap * normalize(N);
        N = calculatenormal(P);
    }
    public void lighting(output color Ci, Oi) {
        normal Nf = faceforward(normalize(N), I);
        vector V = -normalize(I);
        color base = mix(stone->polished(2.4 * transform("object", P)), color(0.3, 0.28, 0.25), gap);
        float kr = (1 - gap) * (0.05 + 0.95 * pow(1 - max(0, Nf . V), 5));
        Ci = Oi * (base * (ambient() + diffuse(Nf)) + kr * color trace(P, reflect(-V, Nf)) +
                   0.25 * (1 - gap) * specular(Nf, V, 0.05));
    }
}
