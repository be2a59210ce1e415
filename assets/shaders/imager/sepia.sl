/* sepia.sl: an old print: brown tones on paper that yellowed and foxed.
   Parameters: strength, papercolor, inkcolor, spots (stains of age), border in pixels. */
imager sepia(float strength = 1; float spots = 0.5; color papercolor = color(0.93, 0.80, 0.58);
             color inkcolor = color(0.10, 0.045, 0.018);) {
    color yiq = ctransform("YIQ", Ci);
    float tone = pow(clamp(comp(yiq, 0), 0, 1), 0.6);
    color print = spline(tone, inkcolor, inkcolor, mix(inkcolor, papercolor, 0.28), papercolor,
                         papercolor * 1.08);
    float stain = smoothstep(0.62, 0.85, float noise(0.021 * P) * 0.8 + 0.3 * float noise(0.09 * P));
    print *= mix(color(1, 1, 1), color(0.72, 0.55, 0.32), spots * stain);
    Ci = mix(Ci, print, strength);
    Oi = 1;
    alpha = 1;
}
