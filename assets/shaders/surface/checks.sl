/* checks.sl: the classic checkerboard, filtered over each pixel's width, so that it turns grey in the
   distance instead of crawling.
   Parameters: freq (checks along s and t), the two colours, Ka Kd Ks roughness. */
surface checks(float Ka = 1; float Kd = 0.85; float Ks = 0.25; float roughness = 0.06;
               float sfreq = 16; float tfreq = 8; color lightcolor = color(0.86, 0.82, 0.72);
               color darkcolor = color(0.07, 0.09, 0.13);) {
    /* The integral of a square wave from 0 to x; its mean over a width is what a pixel sees. */
    float square(float x) {
        float f = x - floor(x);
        return floor(x) * 0.5 + min(f, 0.5);
    }
    float wave(float x; float w) {
        return 2 * (square(x + 0.5 * w) - square(x - 0.5 * w)) / w - 1;
    }
    float x = 0.5 * sfreq * s;
    float y = 0.5 * tfreq * t;
    float wx = max(abs(Du(x) * du) + abs(Dv(x) * dv), 0.0001);
    float wy = max(abs(Du(y) * du) + abs(Dv(y) * dv), 0.0001);
    float check = 0.5 + 0.5 * wave(x, wx) * wave(y, wy);
    normal Nf = faceforward(normalize(N), I);
    Oi = Os;
    Ci = Os * (mix(darkcolor, lightcolor, check) * (Ka * ambient() + Kd * diffuse(Nf)) +
               Ks * specular(Nf, -normalize(I), 8 * roughness));
}
