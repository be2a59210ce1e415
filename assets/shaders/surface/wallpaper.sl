/* wallpaper.sl: a room of about 1900: stripes with a climbing ornament of leaves and buds, printed a
   little out of register.
   Parameters: repeats along s, the four inks, Ka Kd, gloss of the gold ink. */
surface wallpaper(float Ka = 1; float Kd = 0.9; float Ks = 0.35; float repeats = 10;
                  color papercolor = color(0.74, 0.70, 0.58); color stripecolor = color(0.60, 0.60, 0.47);
                  color leafcolor = color(0.18, 0.28, 0.20); color goldcolor = color(0.60, 0.40, 0.12);) {
    float x = repeats * s;
    float y = repeats / 2 * t;
    float w = max(abs(Du(x) * du) + abs(Dv(x) * dv), abs(Du(y) * du) + abs(Dv(y) * dv));
    w = max(w, 0.004);
    float fx = x - floor(x) - 0.5;
    float fy = y - floor(y) - 0.5;

    float stripe = filterstep(0.32, abs(fx), abs(fx) + w, "filter", "catmull-rom");
    color Ct = mix(papercolor, stripecolor, stripe);

    /* A stem that swings left and right, with a leaf at each turn. */
    float swing = 0.11 * sin(2 * PI * fy);
    float stem = 1 - smoothstep(0.008, 0.008 + w, abs(fx - swing));
    float leaves = 0;
    float veins = 0;
    uniform float k;
    for (k = -1; k <= 1; k += 2) {
        /* The leaf's own axes: it points up and out from the stem. */
        point tip = rotate(point(fx - k * 0.05, fy - k * 0.22, 0), -k * radians(52),
                           point(0, 0, 0), point(0, 0, 1));
        float along = ycomp(tip) / 0.17;
        float across = xcomp(tip) / 0.062;
        float shape = across * across - (1 - along) * (1 + along) * (1 - 0.5 * along);
        if (abs(along) < 1) {
            leaves = max(leaves, 1 - smoothstep(0, 0.25 + 4 * w, shape + 0.12));
            veins = max(veins, (1 - smoothstep(0.06, 0.06 + 16 * w, abs(across))) * step(shape, 0));
        }
    }
    float bud = sqrt((fx + 0.11) * (fx + 0.11) + 1.4 * (fy + 0.02) * (fy + 0.02));
    float petals = 0.062 + 0.014 * cos(5 * atan(fy + 0.02, fx + 0.11));
    float gold = 1 - smoothstep(petals, petals + w, bud);
    gold *= smoothstep(0.016, 0.016 + w, bud);
    Ct = mix(Ct, leafcolor, max(stem, leaves));
    Ct = mix(Ct, papercolor, 0.7 * veins * leaves);
    Ct = mix(Ct, goldcolor, gold);
    Ct *= 0.93 + 0.14 * float noise(90 * s, 45 * t);
    normal Nf = faceforward(normalize(N), I);
    Oi = Os;
    Ci = Os * (Ct * (Ka * ambient() + Kd * diffuse(Nf)) +
               Ks * gold * goldcolor * 2 * specular(Nf, -normalize(I), 0.8));
}
