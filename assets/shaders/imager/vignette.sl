/* vignette.sl: a lens that darkens towards the corners (cos to the fourth), and bleeds a little
   colour there.
   Parameters: strength 0..1, width (how wide the lens looks: larger is darker), warmth of the edge. */
imager vignette(float strength = 0.9; float width = 1.25; color edgecolor = color(0.55, 0.38, 0.28);) {
    uniform float size[2] = {640, 480};
    float format3[3] = {640, 480, 1};
    float known = option("Format", format3);
    float x = 2 * xcomp(P) / format3[0] - 1;
    float y = 2 * ycomp(P) / format3[1] - 1;
    float r2 = (x * x + y * y) * 0.5 * width * width;
    float cos2 = 1 / (1 + r2);
    float light = mix(1, cos2 * cos2, strength);
    Ci *= mix(edgecolor, color(1, 1, 1), light) * mix(0.6, 1, light);
}
