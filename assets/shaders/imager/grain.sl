/* grain.sl: old fast film: grain that is strongest in the middle tones, another one each frame.
   Parameters: amount, size in pixels, colored (0 grey .. 1 colour film), fade (lifted blacks). */
imager grain(float amount = 0.16; float size = 1.5; float colored = 0.35; float fade = 0.02;) {
    point Q = P / size;
    setzcomp(Q, 40 * time);
    color grey = float cellnoise(Q) + float noise(1.7 * Q) - 1;
    color tri = color cellnoise(Q + vector(7, 11, 3)) - color(0.5, 0.5, 0.5);
    float tone = (Ci[0] + Ci[1] + Ci[2]) / 3;
    float middle = 4 * sqrt(max(tone, 0)) * max(0, 1 - 0.8 * sqrt(max(tone, 0)));
    Ci = Ci * (1 - fade) + fade + amount * 0.4 * middle * sqrt(max(tone, 0)) *
         mix(grey, tri, colored);
    Ci = max(Ci, color(0, 0, 0));
}
