/* whitecard.sl: a white card that glows, brightest in its middle: something for metal to mirror.
   Parameters: its strength and colour. */
surface whitecard(float strength = 2.2; color lightcolor = color(1, 0.98, 0.95);) {
    float x = 2 * s - 1;
    float y = 2 * t - 1;
    float edge = 1 - smoothstep(0.75, 1, max(abs(x), abs(y)));
    Oi = 1;
    Ci = strength * lightcolor * edge * (1 - 0.35 * (x * x + y * y) * 0.5);
}
