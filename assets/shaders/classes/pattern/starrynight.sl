/* starrynight.sl: strokes of paint that flow around whirls. Each whirl is a struct of an array.
   Parameters: whirls, strokes, night, moon. */
struct Whirl {
    point centre = 0;
    float size = 0.4;
    float spin = 1;
}
class starrynight(uniform float whirls = 9; float strokes = 34; color night = color(0.05, 0.12, 0.42);
                  color moon = color(0.98, 0.85, 0.4);) {
    Whirl sky[];
    varying float glow = 0, stroke = 0, tone = 0;

    public void construct() {
        uniform float k;
        resize(sky, whirls);
        for (k = 0; k < whirls; k += 1) {
            sky[k]->centre = point(2 * mod(0.618 * k + 0.1, 1), 0.15 + 0.7 * mod(0.755 * k, 1), 0);
            sky[k]->size = 0.1 + 0.14 * mod(0.371 * k + 0.5, 1);
            sky[k]->spin = mod(k, 2) < 0.5 ? 1 : -1;
        }
    }
    public void begin() {
        point Q = point(2 * s, t, 0);
        float k, turn = 0.6 * float pnoise(3 * Q, point(6, 1000, 1000));
        glow = 0;
        for (k = 0; k < arraylength(sky); k += 1) {
            /* Around the back the sky goes on. */
            point centre = sky[k]->centre;
            centre += vector(2 * round((Q[0] - centre[0]) / 2), 0, 0);
            float r = distance(Q, centre) / sky[k]->size;
            glow += exp(-4 * r * r);
            turn += sky[k]->spin * 2.2 * exp(-r);
            Q = rotate(Q, 1.5 * sky[k]->spin * exp(-1.2 * r * r), centre, centre + vector(0, 0, 1));
        }
        float lane = strokes * (Q[1] + 0.12 * turn);
        stroke = abs(2 * mod(lane, 1) - 1);
        /* Strokes finer than a grid's points blur to their mean. */
        float footprint = strokes * (abs(Du(Q[1]) * du) + abs(Dv(Q[1]) * dv));
        if (gridmin(footprint) > 0.5)
            stroke = 0.5;
        else if (gridmax(footprint) > 0.25)
            stroke = mix(stroke, 0.5, smoothstep(0.25, 0.5, footprint));
        tone = float cellnoise(floor(lane), mod(floor(9 * Q[0] + 3 * float cellnoise(lane)), 18));
    }
    public void displacement(output point P; output normal N) {
        P += 0.012 * sqrt(max(0, 1 - stroke * stroke)) * normalize(N);
        N = calculatenormal(P);
    }
    public void surface(output color Ci, Oi) {
        normal Nf = faceforward(normalize(N), I);
        color base = mix(night, color(0.35, 0.6, 0.8), 0.75 * tone * tone);
        base = mix(base, moon, smoothstep(0.1, 0.75, glow + 0.25 * (tone - 0.5)));
        base *= mix(1.05, 0.7, stroke);
        Ci = Oi * (base * (ambient() + diffuse(Nf)) + 0.12 * specular(Nf, -normalize(I), 0.12));
    }
}
