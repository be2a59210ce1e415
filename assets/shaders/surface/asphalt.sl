/* asphalt.sl: a road after rain: grey stones in tar, a worn white line, puddles that mirror.
   Parameters: scale (stones per unit), puddles 0..1, line (its half width; 0: none), Ka Kd Ks. */
surface asphalt(float Ka = 1; float Kd = 0.8; float Ks = 0.35; float scale = 45; float puddles = 0.5;
                float line = 0.12; color tarcolor = color(0.055, 0.055, 0.06);
                color stonecolor = color(0.22, 0.21, 0.20); color paintcolor = color(0.72, 0.71, 0.66);) {
    point Pw = transform("world", P);
    point Q = scale * Pw;
    float width = scale * sqrt(area(P));
    float fade = 1 - smoothstep(0.4, 1.5, width);
    float stone = mix(0.5, smoothstep(0.45, 0.6, float noise(Q)), fade);
    float tone = mix(0.5, float cellnoise(0.8 * Q), fade);
    color Ct = mix(tarcolor, stonecolor * (0.6 + 0.8 * tone), stone);
    Ct *= 0.75 + 0.5 * float noise(1.3 * Pw);

    float x = xcomp(Pw) - 0.95;
    float paint = filterstep(-line, x, "width", 1.5) * (1 - filterstep(line, x, "width", 1.5));
    paint *= step(0.0001, line) * smoothstep(0.30, 0.45, float noise(7 * Pw) + 0.25 * stone);
    Ct = mix(Ct, paintcolor * (0.8 + 0.2 * tone), 0.85 * paint);

    float low = float noise(0.9 * Pw) * 0.7 + 0.3 * float noise(3.1 * Pw);
    float wet = smoothstep(0.62 - 0.3 * puddles, 0.50 - 0.3 * puddles, low - 0.12);
    float pool = smoothstep(0.50 - 0.3 * puddles, 0.46 - 0.3 * puddles, low - 0.12);
    normal Nrough = calculatenormal(P + 0.012 * (1 - pool) * fade * stone * normalize(N));
    normal Nf = faceforward(normalize(Nrough), I);
    vector In = normalize(I);
    float kr = pool * (0.03 + 0.97 * pow(1 - clamp(-(Nf . In), 0, 1), 5));
    Oi = Os;
    Ci = Os * (Ct * (1 - 0.5 * wet) * (Ka * ambient() + Kd * diffuse(Nf)) +
               kr * trace(P, reflect(In, Nf)) + Ks * (0.25 + wet) * specular(Nf, -In, 8 * mix(0.2, 0.04, pool)));
}
