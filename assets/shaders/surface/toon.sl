/* toon.sl: a cartoon's cel: a few flat tones with clean borders, a hard highlight, an ink outline.
   Parameters: tones (how many steps of light), the paint's colour, outline width (0..1), softness of
   the steps, the highlight's size. */
surface toon(color paint = color(0.90, 0.30, 0.16); float tones = 3; float ambience = 0.35;
             float outline = 0.28; float highlight = 0.08; float softness = 0.02;
             color inkcolor = color(0.05, 0.03, 0.06);) {
    normal Nf = faceforward(normalize(N), I);
    vector V = -normalize(I);

    float lit = 0;
    float spark = 0;
    illuminance(P, Nf, PI / 2) {
        vector Ln = normalize(L);
        float strength = (Cl[0] + Cl[1] + Cl[2]) / 3;
        lit += strength * (Ln . Nf);
        vector H = normalize(Ln + V);
        spark = max(spark, strength * pow(max(H . Nf, 0), 60));
    }
    /* A step for each tone; its border is as wide as a pixel at least. */
    float level = clamp(lit, 0, 0.999) * tones;
    float w = max(abs(Du(level) * du) + abs(Dv(level) * dv), softness * tones);
    float base = floor(level);
    float tone = base + smoothstep(1 - w, 1, level - base);
    tone = ambience + (1 - ambience) * tone / tones;

    float facing = Nf . V;
    float wf = abs(Du(facing) * du) + abs(Dv(facing) * dv);
    float ink = 1 - smoothstep(outline - wf, outline + wf, facing);

    color Ct = paint * tone;
    /* Shade shifts to blue, as painters do. */
    color cool = ctransform("hsv", Ct);
    cool = ctransform("hsv", "rgb", color(mod(cool[0] + 0.93 * (1 - tone) * 0.08, 1),
                                          min(1, cool[1] * 1.1), cool[2]));
    Ct = mix(cool, Ct, tone);
    Ct = mix(Ct, color(1, 0.97, 0.9), smoothstep(highlight, highlight + 0.04 + softness, spark) *
                                          step(0.01, highlight));
    Oi = Os;
    Ci = Os * mix(Ct, inkcolor, ink);
}
