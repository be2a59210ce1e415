/* quilt.sl: a padded cover stitched in diamonds, with a button where the seams meet.
   Parameters: ufreq, vfreq (diamonds along s and t), puff, seam (width), button (size). */
displacement quilt(float ufreq = 14; float vfreq = 7; float puff = 0.10; float seam = 0.10;
                   float button = 0.16;) {
    float a = ufreq * s + vfreq * t;
    float b = ufreq * s - vfreq * t;
    float da = abs(mod(a + 0.5, 1) - 0.5);
    float db = abs(mod(b + 0.5, 1) - 0.5);
    float pad = sqrt(abs(sin(PI * a)) * abs(sin(PI * b)) + 0.0004);
    float stitch = smoothstep(0, seam, min(da, db));
    /* Little folds draw in towards the buttons. */
    float r = sqrt(da * da + db * db);
    float fold = 0.12 * sin(18 * atan(db, da + 0.0001)) * (1 - smoothstep(button, 0.42, r)) *
                 smoothstep(0.02, button, r);
    float knob = button * sqrt(max(0, 1 - (r / button) * (r / button)));
    float height = pad * (0.55 + 0.45 * stitch) + fold * stitch;
    P += puff * max(height, 1.6 * knob) * normalize(N);
    N = calculatenormal(P);
}
