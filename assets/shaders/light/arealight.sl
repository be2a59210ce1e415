/* arealight.sl: a glowing sheet, or with radius a ball, that softens shadows: each sample of a
   pixel sees another of its points. It shines along z.
   Parameters: intensity, lightcolor, width and height of the sheet (0: shine from P). */
light arealight(float intensity = 16; color lightcolor = color(1, 0.97, 0.92); float width = 1.6;
                float height = 1.6;) {
    uniform vector out = normalize(vector "shader" (0, 0, 1));
    vector across = vector "shader" (1, 0, 0);
    vector up = vector "shader" (0, 1, 0);
    point spot = P + width * (float random() - 0.5) * across +
                 height * (float random() - 0.5) * up;
    illuminate(spot, out, PI / 2) {
        /* A sheet seen from the side is narrow. */
        float facing = max(0, normalize(L) . out);
        Cl = intensity * facing * lightcolor / (L . L);
    }
}
