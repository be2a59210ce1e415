/* snow.sl: fresh snow: soft and bluish in the shade, with crystals that glint as one moves.
   Parameters: sparkle, crystals (per unit), drift (unevenness), colours of light and shade, Ka Kd. */
surface snow(float Ka = 1.1; float Kd = 0.75; float sparkle = 0.9; float crystals = 70;
             float drift = 0.05; color snowcolor = color(0.93, 0.95, 0.97);
             color shadecolor = color(0.45, 0.58, 0.85);) {
    point Q = transform("shader", P);
    float bumps = float noise(3 * Q) + 0.25 * float noise(13 * Q) + 0.06 * float noise(60 * Q);
    normal Nn = calculatenormal(P + drift * bumps * normalize(N));
    normal Nf = faceforward(normalize(Nn), I);
    vector V = -normalize(I);
    color soft = 0;
    illuminance(P + 0.15 * normalize(N), Nf, PI) {
        float c = 0.5 + 0.5 * (normalize(L) . Nf);
        soft += Cl * c * c;
    }
    color lit = Kd * soft;
    float level = clamp(comp(lit, 1), 0, 1);
    /* A crystal is a small mirror that leans any way; few of them look at the lamp. */
    point cell = crystals * Q;
    float seen = 1 - smoothstep(0.5, 1.5, crystals * sqrt(area(P)));
    normal Nc = normalize(Nf + 1.6 * (vector cellnoise(cell) - vector(0.5, 0.5, 0.5)));
    color glint = sparkle * seen * step(0.8, float cellnoise(cell + vector(5, 5, 5))) *
                  specular(Nc, V, 0.16);
    Oi = Os;
    Ci = Os * (snowcolor * mix(shadecolor, color(1, 1, 1), smoothstep(0, 0.8, level)) *
               (Ka * ambient() + lit) + glint);
}
