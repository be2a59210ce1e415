/* vignette.sl: a lens that darkens towards the corners (cos to the fourth), and bleeds a little
   colour there.
   Parameters: strength 0..1, width (how wide the lens looks: larger is darker), warmth of the edge. */
imager vignette(float strength = 0.9; float width = 1.25; color edgecolor = color(0.55, 0.38, 0.28);) {
    point Pn = transform("raster", "NDC", P);
    float x = 2 * xcomp(Pn) - 1;
    float y = 2 * ycomp(Pn) - 1;
    /* In a wide picture the circle stays a circle. */
    float size[3] = {1, 1, 1};
    if (option("Format", size) == 1 && size[1] > 0)
        x *= min(2, size[0] * size[2] / size[1]);
    float r2 = (x * x + y * y) * 0.5 * width * width;
    float cos2 = 1 / (1 + r2);
    float light = mix(1, cos2 * cos2, strength);
    Ci *= mix(edgecolor, color(1, 1, 1), light) * mix(0.6, 1, light);
}
