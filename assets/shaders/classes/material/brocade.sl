/* brocade.sl: silk with a damask pattern: threads of the ground lie across, those of the figure
   along, so each shines from other sides.
   Parameters: repeats, ground, figure, shine. */
class brocade(float repeats = 7; color ground = color(0.3, 0.02, 0.06);
              color figure = color(0.75, 0.52, 0.2); float shine = 0.7;) {
    varying float inside = 0;
    varying vector thread = 0;
    varying color base = 0;

    /* A flower with a stalk, in a cell of -1 to 1. */
    float flower(float x, y) {
        float angle = atan(y, x), r = sqrt(x * x + y * y);
        float petals = 0.52 + 0.2 * cos(6 * angle);
        float f = 1 - smoothstep(petals - 0.03, petals + 0.03, r);
        f -= 1 - smoothstep(0.2, 0.24, r);
        f = max(f, 1 - smoothstep(0.1, 0.14, r));
        float stalk = abs(y - 0.35 * sin(3.2 * x)) - 0.07;
        return max(f, (1 - smoothstep(0, 0.03, stalk)) * step(0.66, r));
    }
    public void begin() {
        float column = floor(2 * repeats * s), row = repeats * t + 0.5 * mod(column, 2);
        inside = flower(2 * mod(2 * repeats * s, 1) - 1, 2 * mod(row, 1) - 1);
        float cross = mod(260 * (inside > 0.5 ? t : s) * repeats / 7, 1);
        vector along = normalize(dPdu), across = normalize(dPdv);
        thread = mix(along, across, inside);
        base = mix(ground, figure, inside) * mix(0.8, 1.1, abs(2 * cross - 1));
    }
    public void displacement(output point P; output normal N) {
        P += 0.008 * inside * normalize(N);
        N = calculatenormal(P);
    }
    public void lighting(output color Ci, Oi) {
        normal Nf = faceforward(normalize(N), I);
        vector V = -normalize(I), T = normalize(thread);
        color silk = 0;
        illuminance(P, Nf, PI / 2) {
            vector H = normalize(normalize(L) + V);
            silk += Cl * pow(max(0, 1 - (T . H) * (T . H)), 24) * max(0, normalize(L) . Nf);
        }
        Ci = Oi * (base * (ambient() + 0.75 * diffuse(Nf)) + shine * (base + 0.08) * silk);
    }
}
