/* hammered.sl: sheet metal formed with a round hammer: shallow facets side by side.
   Parameters: scale (blows per unit), depth. */
displacement hammered(float scale = 5.5; float depth = 0.03;) {
    point Q = scale * transform("object", P);
    point corner = point(floor(xcomp(Q)), floor(ycomp(Q)), floor(zcomp(Q)));
    float near = 3;
    uniform float i, j, k;
    for (i = -1; i <= 1; i += 1) {
        for (j = -1; j <= 1; j += 1) {
            for (k = -1; k <= 1; k += 1) {
                point cell = corner + vector(i, j, k) + vector(0.5, 0.5, 0.5);
                vector away = Q - (cell + 0.8 * (vector cellnoise(cell) - vector(0.5, 0.5, 0.5)));
                near = min(near, away . away);
            }
        }
    }
    P += depth * (near - 0.4) * normalize(N);
    N = calculatenormal(P);
}
