/* etching.sl: an old engraving: lines along the form, thicker in the shade, crossed where it is
   darkest.
   Parameters: lines (along t), contrast, waver (of the hand), ink and paper. */
surface etching(float lines = 46; float contrast = 1.15; float waver = 0.35;
                color inkcolor = color(0.07, 0.05, 0.04); color papercolor = color(0.91, 0.87, 0.77);) {
    float hatch(float x; float dark) {
        float w = max(abs(Du(x) * du) + abs(Dv(x) * dv), 0.0001);
        float d = abs(mod(x, 1) - 0.5);
        float half = 0.5 * dark;
        float ink = clamp((half - d) / w + 0.5, 0, 1);
        return mix(ink, dark, smoothstep(0.5, 1, w));
    }
    normal Nf = faceforward(normalize(N), I);
    color light = 0.75 * diffuse(Nf) + ambient();
    float tone = clamp(contrast * (light[0] + light[1] + light[2]) / 3, 0, 1);
    point Q = transform("object", P);
    float hand = waver * float noise(4 * Q);
    float x = lines * t + hand;
    float y = 0.7 * lines * (1.2 * s + 0.6 * t) + hand;
    float z = 0.7 * lines * (1.2 * s - 0.6 * t) - hand;
    float ink = hatch(x, clamp(0.95 - 1.3 * tone, 0, 0.85));
    ink = max(ink, hatch(y, clamp(0.62 - 1.6 * tone, 0, 0.7)));
    ink = max(ink, hatch(z, clamp(0.34 - 1.6 * tone, 0, 0.6)));
    float edge = clamp(-(Nf . normalize(I)), 0, 1);
    ink = max(ink, 1 - smoothstep(0.12, 0.2, edge));
    Oi = Os;
    Ci = Os * mix(papercolor, inkcolor, ink * (0.85 + 0.15 * float noise(60 * Q)));
}
