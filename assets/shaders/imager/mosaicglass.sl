/* mosaicglass.sl: the picture under a leaded window: dark lines between cells, each lit a little
   differently.
   Parameters: cell in pixels, lead (width of the lines), variation. */
imager mosaicglass(float cell = 26; float lead = 1.1; float variation = 0.45;) {
    float x = xcomp(P) / cell;
    float y = ycomp(P) / cell;
    float f1 = 9, f2 = 9, id = 0;
    float i, j;
    for (i = -1; i <= 1; i += 1) {
        for (j = -1; j <= 1; j += 1) {
            float cx = floor(x) + i + 0.5;
            float cy = floor(y) + j + 0.5;
            float dx = cx + 0.8 * (float cellnoise(cx, cy) - 0.5) - x;
            float dy = cy + 0.8 * (float cellnoise(cx + 9, cy + 5) - 0.5) - y;
            float d = sqrt(dx * dx + dy * dy);
            if (d < f1) {
                f2 = f1;
                f1 = d;
                id = float cellnoise(cx + 20, cy + 40);
            } else if (d < f2)
                f2 = d;
        }
    }
    float border = smoothstep(0, lead / cell, (f2 - f1) * 0.5 - 0.4 * lead / cell);
    Ci *= border * (1 + variation * (id - 0.5));
}
