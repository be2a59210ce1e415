/* cobbles.sl: a street of round stones set in sand; each leans and stands a little differently.
   Parameters: scale (stones per unit), height, roundness, grain (roughness of a stone). */
displacement cobbles(float scale = 2.6; float height = 0.12; float roundness = 0.5;
                     float grain = 0.010;) {
    point Q = transform("shader", P);
    float x = scale * xcomp(Q) + 0.15 * float noise(2.3 * Q);
    float y = scale * ycomp(Q) + 0.15 * float noise(2.3 * Q + vector(5, 2, 9));
    float f1 = 8;
    float f2 = 8;
    float stone = 0;
    uniform float i, j;
    for (i = -1; i <= 1; i += 1)
        for (j = -1; j <= 1; j += 1) {
            float cx = floor(x) + i + 0.5;
            float cy = floor(y) + j + 0.5;
            /* Rows are shifted as a paver lays them; half of the cell is chance. */
            float px = cx + 0.55 * (float cellnoise(cx, cy) - 0.5);
            float py = cy + 0.55 * (float cellnoise(cx + 31, cy + 7) - 0.5);
            float d = sqrt((px - x) * (px - x) + (py - y) * (py - y));
            if (d < f1) {
                f2 = f1;
                f1 = d;
                stone = float cellnoise(cx + 11, cy + 53);
            } else
                f2 = min(f2, d);
        }
    float dome = smoothstep(0.02, roundness, f2 - f1);
    float top = dome * (0.75 + 0.4 * stone) - 0.25 * f1 * f1;
    top += grain / height * (dome * (float noise(40 * Q) - 0.5) + 0.7 * (float noise(90 * Q) - 0.5));
    P += height * top * normalize(N);
    N = calculatenormal(P);
}
