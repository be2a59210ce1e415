/* tiles.sl: Portuguese wall tiles: on each a painted flower of circles and a frame, grouted, glazed.
   Parameters: size (world units), grout (share of a tile), the three paints, Ka Kd Ks roughness Kr. */
#define AA(edge, x) smoothstep((edge) - w, (edge) + w, (x))
#define RING(r, radius, width) (AA((radius) - (width), r) * (1 - AA((radius) + (width), r)))

surface tiles(float Ka = 1; float Kd = 0.85; float Ks = 0.5; float roughness = 0.03; float Kr = 0.6;
              float size = 0.5; float grout = 0.03;
              color ground = color(0.83, 0.82, 0.76); color blue = color(0.05, 0.13, 0.42);
              color yellow = color(0.80, 0.52, 0.08); color groutcolor = color(0.36, 0.33, 0.29);) {
    normal Nf = faceforward(normalize(N), I);
    vector In = normalize(I);
    point Pw = transform("world", P);
    normal Nw = normalize(ntransform("world", Nf));
    float x = xcomp(Pw) / size;
    float y = ycomp(Pw) / size;
    if (abs(zcomp(Nw)) < 0.7) {
        x = (xcomp(Nw) * ycomp(Pw) - ycomp(Nw) * xcomp(Pw)) / size;
        y = zcomp(Pw) / size;
    }
    float w = 0.7 * max(abs(Du(x) * du) + abs(Dv(x) * dv), abs(Du(y) * du) + abs(Dv(y) * dv));
    w = clamp(w, 0.003, 0.4);
    float row = floor(y);
    float column = floor(x);
    float fx = x - column - 0.5;
    float fy = y - row - 0.5;

    /* Hand-painted: lines waver, each tile its own way; glaze varies. */
    float own = float cellnoise(column + 0.5, row + 0.5);
    fx += 0.016 * (float noise(5 * x + 31 * own, 5 * y) - 0.5) * 2;
    fy += 0.016 * (float noise(5 * x, 5 * y + 57 * own) - 0.5) * 2;
    float r = sqrt(fx * fx + fy * fy);
    float angle = atan(fy, fx);

    float flower = 0.27 + 0.07 * cos(8 * angle);
    color Ct = mix(ground, blue, 1 - AA(flower, r));
    Ct = mix(Ct, yellow, 1 - AA(0.20 + 0.05 * cos(8 * angle), r));
    Ct = mix(Ct, blue, RING(r, 0.085, 0.03));
    Ct = mix(Ct, blue, RING(r, 0.42, 0.012));
    /* Quarter circles in the corners meet those of the neighbours. */
    float cx = 0.5 - abs(fx);
    float cy = 0.5 - abs(fy);
    float corner = sqrt(cx * cx + cy * cy);
    Ct = mix(Ct, blue, RING(corner, 0.26, 0.022));
    Ct = mix(Ct, yellow, RING(corner, 0.17, 0.045));
    Ct = mix(Ct, blue, 1 - AA(0.09, corner));
    Ct *= 0.86 + 0.2 * own + 0.12 * (float noise(3 * x, 3 * y) - 0.5);

    float edge = min(cx, cy);
    float glazed = AA(grout / 2, edge);
    glazed = mix(glazed, 1 - grout * 2, smoothstep(0.1, 0.35, w));
    Ct = mix(groutcolor, Ct, glazed);
    float kr = Kr * (0.04 + 0.96 * pow(1 - clamp(-(Nf . In), 0, 1), 5));
    Oi = Os;
    Ci = Os * (Ct * (Ka * ambient() + Kd * diffuse(Nf)) +
               glazed * (kr * trace(P, reflect(In, Nf)) + Ks * specular(Nf, -In, 8 * roughness)));
}
