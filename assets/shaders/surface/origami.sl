/* origami.sl: folded washi paper: long fibres in it, printed waves (seigaiha: rings of circles, row
   over row), with gold.
   Parameters: waves (along s), rings, paper and ink colours, gold, translucence. */
#define RINGLINE(d) (1 - smoothstep(0.06, 0.06 + w * 4, abs(mod((d) * rings, 1) - 0.5) - 0.18))

surface origami(float Ka = 1; float Kd = 0.85; float Ks = 0.5; float waves = 16; float rings = 3;
                float translucence = 0.25; color papercolor = color(0.86, 0.84, 0.78);
                color inkcolor = color(0.10, 0.20, 0.38); color goldcolor = color(0.75, 0.55, 0.20);) {
    float x = waves * s;
    float y = waves * t;
    float w = clamp(abs(Du(x) * du) + abs(Dv(x) * dv) + abs(Du(y) * du) + abs(Dv(y) * dv), 0.004, 1);
    float ink = 0;
    float gold = 0;
    float found = 0;
    /* The lowest row of circles lies on top. */
    float row = floor(2 * y) - 2;
    while (found == 0) {
        float cy = 0.5 * (row + 1);
        float cx = floor(x + 0.5 * mod(row, 2)) + 0.5 - 0.5 * mod(row, 2);
        float d = sqrt((x - cx) * (x - cx) + 4 * (y - cy) * (y - cy) * 0.25 * 4) / 1.0;
        if (d < 0.5 * 1.0 || row > 2 * y + 3) {
            found = 1;
            ink = RINGLINE(2 * d);
            gold = smoothstep(0.86, 0.9, 2 * d);
            break;
        }
        row += 1;
    }
    point Q = transform("object", P);
    float fibre = 0;
    uniform float k;
    for (k = 0; k < 3; k += 1) {
        point q = rotate(Q, 1.1 * k, point(0, 0, 0), point(1, 2, 3));
        float n = float noise(point(4 * xcomp(q), 30 * ycomp(q), 30 * zcomp(q)));
        fibre = max(fibre, smoothstep(0.70, 0.76, n));
    }
    normal Nf = faceforward(normalize(N), I);
    color back = diffuse(-Nf);
    color Ct = mix(papercolor, inkcolor, 0.9 * ink);
    Ct = mix(Ct, goldcolor, gold);
    Ct = mix(Ct, papercolor * 1.08, 0.25 * fibre * (1 - ink));
    Oi = Os;
    Ci = Os * (Ct * (Ka * ambient() + Kd * diffuse(Nf) + translucence * back) +
               Ks * gold * goldcolor * specular(Nf, -normalize(I), 1.2));
}
