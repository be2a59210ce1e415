/* snakeskin.sl: overlapping scales with a diamond pattern down the back, each scale with its own
   gloss.
   Parameters: rows (scales along t), around (scales along s), pattern (diamonds), the three colours,
   Ka Kd Ks roughness. */
surface snakeskin(float Ka = 1; float Kd = 0.8; float Ks = 0.5; float roughness = 0.07;
                  float rows = 34; float around = 46; float pattern = 6;
                  color backcolor = color(0.28, 0.22, 0.09); color darkcolor = color(0.045, 0.035, 0.02);
                  color lightcolor = color(0.66, 0.58, 0.32);) {
    float y = rows * t;
    float w = max(abs(Du(y) * du) + abs(Dv(y) * dv), 0.001);
    float height = -1;
    float edge = 1;
    float sx = 0, sy = 0;
    /* A point lies under up to three rows of scales: the uppermost that covers it is seen. */
    uniform float k;
    for (k = 1; k >= -1; k -= 1) {
        float row = floor(y) + k;
        float x = around * s + 0.5 * mod(row, 2);
        float column = floor(x);
        float fx = 2 * (x - column) - 1;
        float fy = y - row - 0.5;
        /* A scale: round below, pointed above, one and a half rows long. */
        float d = fx * fx + fy * fy * mix(1.1, 0.55, step(0, fy));
        if (d < 1 && height < 0) {
            height = sqrt(1 - d);
            edge = 1 - d;
            sx = column + 0.5 - 0.5 * mod(row, 2);
            sy = row + 0.5;
        }
    }
    if (height < 0) {
        height = 0;
        edge = 0;
        sx = floor(around * s) + 0.5;
        sy = floor(y) + 0.5;
    }
    float keel = 0.3 * (1 - smoothstep(0, 0.25, abs(mod(around * s + 0.5 * mod(sy - 0.5, 2), 1) - 0.5)));
    normal Nn = calculatenormal(P + 0.025 * (height + keel * edge) * normalize(N));
    normal Nf = faceforward(normalize(Nn), I);
    vector V = -normalize(I);

    /* The pattern is painted scale by scale. */
    float a = sx / around * pattern;
    float b = sy / rows * pattern / 2;
    float diamond = abs(mod(a + b, 1) - 0.5) + abs(mod(a - b, 1) - 0.5);
    color Ct = mix(lightcolor, backcolor, smoothstep(0.30, 0.36, diamond));
    Ct = mix(Ct, darkcolor, smoothstep(0.62, 0.70, diamond));
    Ct = mix(Ct, darkcolor, smoothstep(0.26, 0.30, diamond) * (1 - smoothstep(0.36, 0.40, diamond)));
    Ct *= 0.8 + 0.4 * float cellnoise(sx, sy);
    Ct *= mix(smoothstep(0, 0.25, edge) * 0.7 + 0.3, 0.85, smoothstep(0.4, 1, w));
    Oi = Os;
    Ci = Os * (Ct * (Ka * ambient() + Kd * diffuse(Nf)) +
               Ks * smoothstep(0, 0.4, edge) * specular(Nf, V, 8 * roughness));
}
