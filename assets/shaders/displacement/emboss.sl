/* emboss.sl: a pattern stamped into leather or paper: the image `stamp` (its brightness is height),
   or without one a ring of stars.
   Parameters: depth, stamp, repeats in s and t, blur, points of a star. */
displacement emboss(float depth = 0.04; string stamp = ""; float srepeat = 10; float trepeat = 5;
                    float blur = 0.01; float points = 5;) {
    float ss = mod(srepeat * s, 1);
    float tt = mod(trepeat * t, 1);
    float height;
    if (stamp != "") {
        height = float texture(stamp[0], ss, tt, "blur", blur, "swidth", 1, "twidth", 1);
    } else {
        float x = 2 * ss - 1;
        float y = 2 * tt - 1;
        float r = sqrt(x * x + y * y);
        /* Fold the angle into one ray of the star, then it is a straight edge. */
        uniform float wedge = PI / points;
        float a = abs(mod(atan(x, y) + wedge, 2 * wedge) - wedge);
        float edge = ptlined(point(0.72, 0, 0), point(0.30 * cos(wedge), 0.30 * sin(wedge), 0),
                             point(r * cos(a), r * sin(a), 0));
        vector side = point(0.30 * cos(wedge), 0.30 * sin(wedge), 0) - point(0.72, 0, 0);
        vector from = point(r * cos(a), r * sin(a), 0) - point(0.72, 0, 0);
        float inside = sign(xcomp(side) * ycomp(from) - ycomp(side) * xcomp(from));
        height = smoothstep(-0.02, 0.09, inside * edge);
        height = max(height, 0.5 * (1 - smoothstep(0.03, 0.07, abs(r - 0.86))));
    }
    P += depth * height * normalize(N);
    N = calculatenormal(P);
}
