// an imager with Ci, Oi, alpha and P
imager imager_background(color top = color(0.2, 0.4, 0.9); color bottom = 1) {
    float y = ycomp(P) * 0.001;
    Ci += (1 - Oi) * mix(top, bottom, y);
    Oi = 1;
    alpha = 1;
}
