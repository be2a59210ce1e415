/* hair.sl: combed fibres along t, each a little cylinder: light makes bands across them instead of
   spots (Kajiya and Kay's model).
   Parameters: strands (across s), rootcolor and tipcolor along t, Kd, Ks, roughness (as 1/exponent),
   tangle (how much the fibres stray), Ka. */
surface hair(float Ka = 0.8; float Kd = 0.75; float Ks = 0.55; float roughness = 0.02;
             float strands = 170; float tangle = 0.30;
             color rootcolor = color(0.12, 0.045, 0.015);
             color tipcolor = color(0.48, 0.23, 0.08);
             color shinecolor = color(1, 0.82, 0.58);) {
    float bend = tangle * (float pnoise(9 * s, 3 * t, 9, 100) - 0.5);
    float x = strands * (s + 0.12 * bend);
    float w = abs(Du(x) * du) + abs(Dv(x) * dv);
    float fade = 1 - smoothstep(0.4, 1.6, w);
    float strand = floor(x);
    float tone = mix(0.5, float cellnoise(strand + 0.5), fade);
    float round = mix(0.7, sin(PI * (x - strand)), fade);
    float wave = float noise(0.35 * x, 6 * t);

    vector T = normalize(dPdv + 0.55 * (tone - 0.5 + wave - 0.5 + bend) * dPdu *
                                    (length(dPdv) / max(length(dPdu), 0.0001)) * 0.5);
    vector V = -normalize(I);
    normal Nf = faceforward(normalize(N), I);

    float tv = T . V;
    float sv = sqrt(max(0, 1 - tv * tv));
    color diff = 0;
    color spec = 0;
    illuminance(P, Nf, PI / 2 + 0.2) {
        vector Ln = normalize(L);
        float tl = T . Ln;
        float sl = sqrt(max(0, 1 - tl * tl));
        float hang = smoothstep(-0.15, 0.35, Ln . Nf);
        diff += Cl * sl * hang;
        float c = max(0, sl * sv - tl * tv);
        spec += Cl * hang * pow(c, 1 / roughness);
    }
    color Ct = mix(rootcolor, tipcolor, smoothstep(0.05, 0.95, 0.5 * t + 0.5 * tone));
    Ct *= 0.45 + 0.75 * round;
    Oi = Os;
    Ci = Os * (Ct * (Ka * ambient() + Kd * diff) + Ks * (0.4 + 0.6 * round) * shinecolor * spec);
}
