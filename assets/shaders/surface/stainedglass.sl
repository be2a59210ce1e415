/* stainedglass.sl: a church window: coloured panes in lead; light shines through them, so shadows
   have their colours.
   Parameters: scale (panes along t), lead (its width), bubbles, saturation, Ks roughness. */
surface stainedglass(float Ka = 1; float Kd = 0.5; float Ks = 0.6; float roughness = 0.03;
                     float scale = 7; float lead = 0.07; float saturation = 0.9;
                     color leadcolor = color(0.07, 0.07, 0.08);) {
    normal Nf = faceforward(normalize(N), I);
    vector V = -normalize(I);
    float x = 2 * scale * s;
    float y = scale * t;
    float w = max(abs(Du(x) * du) + abs(Dv(x) * dv), abs(Du(y) * du) + abs(Dv(y) * dv));
    float f1 = 9;
    float f2 = 9;
    float id = 0;
    float id2 = 0;
    uniform float i, j;
    for (i = -1; i <= 1; i += 1)
        for (j = -1; j <= 1; j += 1) {
            float cx = floor(x) + i + 0.5;
            float cy = floor(y) + j + 0.5;
            /* The window closes around s: cells repeat. */
            float wx = mod(cx, 2 * scale);
            float dx = cx + 0.75 * (float cellnoise(wx, cy) - 0.5) - x;
            float dy = cy + 0.75 * (float cellnoise(wx + 40, cy) - 0.5) - y;
            float d = max(abs(dx) + 0.4 * abs(dy), abs(dy) + 0.3 * abs(dx));
            if (d < f1) {
                f2 = f1;
                f1 = d;
                id = float cellnoise(wx + 80, cy);
                id2 = float cellnoise(wx, cy + 120);
            } else if (d < f2)
                f2 = d;
        }
    float glass = smoothstep(lead - w, lead + w, f2 - f1);
    color hue = ctransform("hsv", "rgb", color(mod(0.55 + 0.62 * floor(id * 6) / 6, 1), saturation,
                                               0.75 + 0.25 * id2));
    float streak = 0.8 + 0.4 * float noise(3 * x, 9 * y + 5 * id);
    hue *= streak;
    float round = smoothstep(lead, 0, f2 - f1);
    Oi = mix(color(1, 1, 1), color(1, 1, 1) - 0.82 * hue, glass);
    color dull = mix(leadcolor * (Ka * ambient() + Kd * diffuse(Nf)) * (0.6 + round),
                     0.25 * hue * (Ka * ambient() + Kd * diffuse(Nf)), glass);
    Ci = dull + Ks * mix(0.35, 1, glass) * specular(Nf, V, 8 * mix(0.15, roughness, glass));
}
