/* leather.sl: tanned hide: a net of creases between little pads, worn bright on top.
   Parameters: scale (pads per unit), depth of the creases, the colours of pad and crease, Ka Kd Ks
   roughness. */
surface leather(float Ka = 1; float Kd = 0.8; float Ks = 0.35; float roughness = 0.16;
                float scale = 13; float depth = 0.012;
                color padcolor = color(0.30, 0.12, 0.045);
                color creasecolor = color(0.07, 0.025, 0.012);) {
    /* The crease net: distance between the nearest two of scattered points. */
    float net(point q) {
        point corner = point(floor(xcomp(q)), floor(ycomp(q)), floor(zcomp(q)));
        float near = 9;
        float second = 9;
        uniform float n;
        for (n = 0; n < 27; n += 1) {
            uniform float i = mod(n, 3) - 1;
            uniform float j = mod(floor(n / 3), 3) - 1;
            uniform float k = floor(n / 9) - 1;
            point cell = corner + vector(i + 0.5, j + 0.5, k + 0.5);
            float d = distance(q, cell + 0.9 * (vector cellnoise(cell) - vector(0.5, 0.5, 0.5)));
            second = min(second, max(near, d));
            near = min(near, d);
        }
        return second - near;
    }
    point Q = scale * transform("shader", P);
    Q += 0.35 * (vector noise(0.6 * Q) - vector(0.5, 0.5, 0.5));
    float fade = 1 - smoothstep(0.5, 1.4, scale * sqrt(area(P)));
    float d = net(Q);
    float pad = smoothstep(0.02, 0.30, d);
    float grain = float noise(5 * Q);
    normal Nn = calculatenormal(P + normalize(N) * depth * fade * (pad + 0.15 * grain));
    normal Nf = faceforward(normalize(Nn), I);
    vector V = -normalize(I);

    float worn = smoothstep(0.35, 0.8, float noise(0.09 * Q));
    color Ct = mix(creasecolor, padcolor * (0.8 + 0.4 * grain), pad);
    Ct *= 0.85 + 0.5 * worn;
    Oi = Os;
    Ci = Os * (Ct * (Ka * ambient() + Kd * diffuse(Nf)) +
               Ks * mix(0.25, 1, pad) * (0.6 + 0.7 * worn) * specular(Nf, V, 8 * roughness));
}
