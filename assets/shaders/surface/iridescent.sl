/* iridescent.sl: a beetle's wing: the hue runs through the spectrum as it turns away.
   Parameters: hue at the front, range of hues, saturation, Ka Kd Ks roughness, bumps. */
surface iridescent(float Ka = 0.8; float Kd = 0.55; float Ks = 0.7; float roughness = 0.09;
                   float hue = 0.36; float range = 0.52; float saturation = 0.85;
                   float Kr = 0.4; float bumps = 0.02;) {
    point Q = transform("object", P);
    /* The bend of the faces, laid on the smooth normal. */
    normal Nn = normalize(N) - normalize(calculatenormal(P)) +
        normalize(calculatenormal(P + bumps * float noise(5 * Q) * normalize(N)));
    normal Nf = faceforward(normalize(Nn), I);
    vector In = normalize(I);
    float facing = clamp(-(Nf . In), 0, 1);
    float h = hue + range * (1 - facing) + 0.10 * (float noise(1.8 * Q) - 0.5);
    color Ct = color "hsv" (0, 0, 1);
    Ct = ctransform("hsv", "rgb", color(h - floor(h), saturation, 0.35 + 0.5 * facing));
    /* The highlight is of another hue: its light meets the layers at another angle. */
    color Csheen = ctransform("hsl", "rgb", color(mod(h + 0.14, 1), 0.9, 0.6));
    float kr = Kr * (0.12 + 0.88 * pow(1 - facing, 4));
    Oi = Os;
    Ci = Os * (Ct * (Ka * ambient() + Kd * diffuse(Nf)) +
               Ks * Csheen * specular(Nf, -In, 8 * roughness) + Ct * kr * trace(P, reflect(In, Nf)) +
               0.5 * specular(Nf, -In, 0.16));
}
