/* posterise.sl: a screen print: a few inks in flat tones.
   Parameters: levels, saturation, gamma (where the steps fall). */
imager posterise(float levels = 4; float saturation = 1.35; float gamma = 2.2;) {
    color hsv = ctransform("rgb", "hsv", Ci);
    hsv = color(hsv[0], min(1, hsv[1] * saturation), hsv[2]);
    color c = ctransform("hsv", "rgb", hsv);
    float k;
    for (k = 0; k < 3; k += 1) {
        float tone = pow(clamp(comp(c, k), 0, 1), 1 / gamma);
        setcomp(c, k, pow(round(tone * levels) / levels, gamma));
    }
    Ci = c * alpha;
}
