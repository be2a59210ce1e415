/* chalk.sl: a drawing in chalk on slate: the lamps are strokes, one lamp at a time, each in its own
   colour; lamps that call themselves nondiffuse leave no trace.
   Parameters: strokes (per unit), pressure, slatecolor. It asks each lamp for its parameters. */
surface chalk(float strokes = 22; float pressure = 1.25; color slatecolor = color(0.045, 0.055, 0.06);) {
    normal Nf = faceforward(normalize(N), I);
    point Pn = transform("NDC", P);
    float grain = float noise(500 * xcomp(Pn), 500 * ycomp(Pn));
    color drawn = 0;
    float number = 0;
    illuminance(P, Nf, PI / 2) {
        float nondiffuse = 0;
        lightsource("__nondiffuse", nondiffuse);
        float spread = 0;
        if (lightsource("coneangle", spread) == 0)
            spread = 0.5;
        float tone = clamp((normalize(L) . Nf) * (Cl[0] + Cl[1] + Cl[2]) / 3, 0, 1);
        float angle = radians(35 + 70 * number) + 0.1 * spread;
        float x = strokes * 2.2 * (xcomp(Pn) * cos(angle) + ycomp(Pn) * sin(angle));
        float y = strokes * 0.25 * (ycomp(Pn) * cos(angle) - xcomp(Pn) * sin(angle));
        float line = float noise(1.4 * x + 0.6 * float noise(y, x), y + 9 * number);
        float mark = smoothstep(0.62 - 0.42 * tone, 0.72 - 0.30 * tone, 0.7 * line + 0.3 * grain);
        drawn += (1 - nondiffuse) * mark * tone * pressure * (0.35 * color(1, 1, 1) + 0.65 * Cl) *
                 (color(1, 1, 1) - 0 * Ol);
        number += 1;
    }
    float facing = clamp(-(Nf . normalize(I)), 0, 1);
    float outline = 1 - smoothstep(0.16, 0.30, facing + 0.10 * (grain - 0.5));
    drawn = max(drawn, 0.7 * outline * smoothstep(0.3, 0.5, grain) * color(1, 0.98, 0.92));
    Oi = Os;
    Ci = Os * (slatecolor * (0.8 + 0.4 * grain) + drawn);
}
