/* bark.sl: the bark of an old oak: deep furrows along z, ridges that join and part, grey lichen.
   Parameters: scale, stretch along the trunk, depth, lichen, the colours of ridge and furrow, Ka Kd. */
surface bark(float Ka = 1; float Kd = 0.9; float scale = 5; float stretch = 0.28;
             float depth = 0.10; float lichen = 0.6; color ridgecolor = color(0.36, 0.28, 0.20);
             color furrowcolor = color(0.06, 0.04, 0.03); color lichencolor = color(0.40, 0.44, 0.33);) {
    uniform matrix along = scale(matrix 1, point(scale, scale, scale * stretch));
    point Q = transform(along, transform("object", P));
    Q += 0.6 * (vector noise(0.8 * Q) - vector(0.5, 0.5, 0.5));
    float ridge = 0;
    float weight = 0.6;
    float size = 1;
    float width = scale * sqrt(area(P));
    uniform float i;
    for (i = 0; i < 5; i += 1) {
        float fade = 1 - smoothstep(0.3, 1, width * size);
        ridge += weight * fade * abs(2 * float noise(size * Q + vector(i, 2 * i, 0)) - 1);
        weight *= 0.5;
        size *= 2.2;
    }
    float top = smoothstep(0.05, 0.5, ridge);
    normal Nn = calculatenormal(P + depth * top * normalize(N));
    normal Nf = faceforward(normalize(Nn), I);
    color Ct = mix(furrowcolor, ridgecolor, top);
    Ct *= 0.75 + 0.5 * float noise(4 * Q);
    float grey = lichen * smoothstep(0.5, 0.62, float noise(0.5 * Q + vector(3, 7, 1))) *
                 smoothstep(0.3, 0.6, top);
    Ct = mix(Ct, lichencolor * (0.7 + 0.6 * float noise(9 * Q)), grey);
    Oi = Os;
    Ci = Os * Ct * (0.5 + 0.5 * top) * (Ka * ambient() + Kd * diffuse(Nf));
}
