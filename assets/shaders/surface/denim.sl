/* denim.sl: blue jeans: a twill of indigo warp over white weft, faded where it rubs.
   Parameters: threads (per unit of t; twice as many in s), warpcolor, weftcolor, fading, Ka Kd. */
surface denim(float Ka = 1; float Kd = 0.85; float threads = 64; float fading = 0.6;
              color warpcolor = color(0.055, 0.11, 0.27);
              color weftcolor = color(0.66, 0.68, 0.70);) {
    normal Nf = faceforward(normalize(N), I);
    float x = 2 * threads * s;
    float y = threads * t;
    float w = max(abs(Du(x) * du) + abs(Dv(x) * dv), abs(Du(y) * du) + abs(Dv(y) * dv));
    float fade = 1 - smoothstep(0.25, 0.7, w);

    /* Twill: each row of the weft shows under every third warp, one further on. */
    float column = floor(x);
    float row = floor(y);
    float over = mod(column + row, 3);
    float isweft = 0;
    if (over < 1)
        isweft = 1;
    float across = sin(PI * (x - column));
    float along = sin(PI * (y - row));
    float bulge = mix(pow(across, 0.6) * (0.75 + 0.25 * along), along * (0.6 + 0.4 * across), isweft);
    float slub = float noise(0.5 * column, 0.11 * y) - 0.5;
    float slub2 = float noise(0.05 * x, 0.9 * row) - 0.5;

    color warp = warpcolor * (1 + 0.9 * slub);
    color cloth = mix(warp, weftcolor * (1 + 0.5 * slub2), isweft) * (0.45 + 0.65 * bulge);
    color average = (2 * warpcolor + weftcolor) / 3 * 0.85 * (1 + 0.4 * slub2);
    color Ct = mix(average, cloth, fade);

    point Q = transform("shader", P);
    float rubbed = fading * smoothstep(0.42, 0.75, float noise(1.6 * Q) * 0.7 +
                                                       0.3 * float noise(7 * Q));
    Ct = mix(Ct, weftcolor * (0.5 + 0.5 * bulge), 0.45 * rubbed);
    float fuzz = pow(1 - clamp(-(normalize(I) . Nf), 0, 1), 3);
    Oi = Os;
    Ci = Os * (Ct * (Ka * ambient() + Kd * diffuse(Nf)) + 0.25 * fuzz * weftcolor * ambient());
}
