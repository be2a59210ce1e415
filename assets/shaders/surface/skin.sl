/* skin.sl: living skin: light wraps around the form and turns red in the shade, a thin film of oil
   shines, pores and freckles break the evenness.
   Parameters: Ka Kd, oil and roughness of the shine, wrap (how far light creeps past the edge),
   bloodcolor of the scattered light, freckles (how many), pores (how deep). */
surface skin(float Ka = 1; float Kd = 0.95; float oil = 0.22; float roughness = 0.22;
             float wrap = 0.35; float freckles = 0.35; float pores = 0.004;
             color skincolor = color(0.78, 0.50, 0.38);
             color bloodcolor = color(0.75, 0.14, 0.08);
             color frecklecolor = color(0.38, 0.17, 0.09);) {
    point Q = transform("shader", P);
    float fine = scaled_noise(Q, 70);
    /* The bend of the faces, laid on the smooth normal. */
    normal Np = normalize(N) - normalize(calculatenormal(P)) +
        normalize(calculatenormal(P - pores * fine * normalize(N)));
    normal Nf = faceforward(normalize(Np), I);
    normal Nsmooth = faceforward(normalize(N), I);
    vector V = -normalize(I);

    color glow = 0;
    color shine = 0;
    /* Light creeps around the form: lamps are asked a little above the skin. */
    illuminance(P + 0.2 * wrap * Nsmooth, Nsmooth, PI) {
        vector Ln = normalize(L);
        float facing = Ln . Nf;
        float lit = clamp((facing + wrap) / (1 + wrap), 0, 1);
        lit *= lit;
        /* Red reaches further than green and blue. */
        float edge = smoothstep(-wrap, 0.15, facing) * (1 - smoothstep(0.1, 0.6, facing));
        glow += Cl * (lit * color(1, 1, 1) + 0.28 * edge * bloodcolor);
        shine += Cl * max(0, sign(facing)) * specularbrdf(Ln, Nf, V, 8 * roughness);
    }
    float blush = smoothstep(0.35, 0.75, float noise(1.7 * Q));
    color Ct = mix(skincolor, mix(skincolor, bloodcolor, 0.3), blush);
    float spots = smoothstep(0.66, 0.74, float noise(11 * Q) * 0.75 + 0.25 * float noise(23 * Q));
    Ct = mix(Ct, frecklecolor, freckles * spots);
    Ct *= 0.94 + 0.12 * fine;

    float rim = pow(1 - clamp(V . Nsmooth, 0, 1), 3);
    Oi = Os;
    Ci = Os * (Cs * Ct * (Ka * ambient() * (1 + 0.6 * rim) + Kd * glow) + oil * shine);
}

/* Functions may follow their use. Noise about 0.5 that fades to it when finer than a pixel. */
float scaled_noise(point p; float frequency;) {
    extern float du, dv;
    float width = frequency * sqrt(area(p));
    return mix(float noise(frequency * p), 0.5, smoothstep(0.3, 0.9, width));
}
