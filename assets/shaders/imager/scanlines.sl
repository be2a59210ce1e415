/* scanlines.sl: an early colour monitor: lines of red, green and blue phosphor, a dark gap between
   rows, a slight roll of brightness.
   Parameters: pitch in pixels, gap, glow (compensates the dark), roll. */
imager scanlines(float pitch = 3; float gap = 0.4; float glow = 1.75; float roll = 0.1;) {
    float x = xcomp(P) / pitch;
    float y = ycomp(P) / pitch;
    float third = 3 * (x - floor(x));
    color phosphor = color(1 - min(1, abs(third - 0.5)), 1 - min(1, abs(third - 1.5)),
                           1 - min(1, abs(third - 2.5)));
    float row = sin(PI * (y - floor(y)));
    float beam = mix(1 - gap, 1, row * row);
    float hum = 1 + roll * sin(2 * PI * (ycomp(P) / 220 + time));
    Ci = Ci * (0.25 + 1.15 * phosphor) * beam * glow * hum;
}
