/* rivets.sl: plates of a ship: rows of round heads along sunken seams.
   Parameters: plates (across s; half as many along t), heads (on a plate's side), height of a head,
   radius (share of the space between heads), seam (depth). */
displacement rivets(float plates = 6; float heads = 5; float height = 0.045; float radius = 0.30;
                    float seam = 0.02; float inset = 0.09;) {
    float x = plates * s;
    float y = plates / 2 * t;
    float row = floor(y);
    x += 0.5 * mod(row, 2);
    x -= floor(x);
    y -= row;
    /* Fold the four corners of a plate onto one. */
    float fx = 0.5 - abs(x - 0.5);
    float fy = 0.5 - abs(y - 0.5);
    float edge = min(fx, fy);
    float line = edge - inset;
    float along = x;
    if (fx < fy)
        along = y;
    float place = heads * along - floor(heads * along) - 0.5;
    float d = sqrt(place * place + heads * heads * line * line) / radius;
    float head = sqrt(max(0, 1 - d * d));
    if (along < inset || along > 1 - inset)
        head = 0;
    float groove = 1 - smoothstep(0.008, 0.025, edge);
    float buckle = 0.012 * (float noise(3 * x + 7 * row, 3 * y) - 0.5);
    P += (height * head - seam * groove + buckle) * normalize(N);
    N = calculatenormal(P);
}
