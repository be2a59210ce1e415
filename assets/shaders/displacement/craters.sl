/* craters.sl: a dead moon: bowls with raised rims in several sizes, over gentle hills.
   Parameters: Km (height), scale, sizes (how many octaves of craters), density 0..1. */
displacement craters(float Km = 0.10; float scale = 1.5; float sizes = 4; float density = 0.75;) {
    /* One size of craters: the nearest crater of the cell grid gives its profile. */
    float bowls(point q; uniform float seed) {
        point corner = point(floor(xcomp(q)), floor(ycomp(q)), floor(zcomp(q)));
        float sum = 0;
        uniform float i, j, k;
        for (i = -1; i <= 1; i += 1)
            for (j = -1; j <= 1; j += 1)
                for (k = -1; k <= 1; k += 1) {
                    point cell = corner + vector(i + 0.5, j + 0.5, k + 0.5);
                    if (float cellnoise(cell + vector(seed, 0, 0)) > density)
                        continue;
                    point heart = cell + 0.8 * (vector cellnoise(cell + vector(0, seed, 9)) -
                                                vector(0.5, 0.5, 0.5));
                    float radius = 0.22 + 0.24 * float cellnoise(cell + vector(3, seed, 7));
                    float r = distance(q, heart) / radius;
                    /* Floor, wall, rim, apron. */
                    float inside = smoothstep(0.25, 1, r) - 1;
                    float rim = exp(-9 * (r - 1) * (r - 1)) * 0.55;
                    sum += radius * (1.2 * inside + rim);
                }
        return sum;
    }
    point Q = scale * transform("object", P);
    float height = 0.5 * (float noise(1.3 * Q) - 0.5);
    float size = 1;
    uniform float octave;
    for (octave = 0; octave < sizes; octave += 1) {
        height += bowls(Q / size, 13 * octave + 1) * size;
        size *= 0.53;
    }
    height += 0.03 * (float noise(23 * Q) - 0.5);
    P += Km * height / scale * 1.6 * normalize(N);
    N = calculatenormal(P);
}
