/* depthcue.sl: fades into a colour between two depths of the picture, which are fractions of the
   way from the near to the far clipping plane. */
volume depthcue(float mindistance = 0, maxdistance = 1; color background = 0) {
    float faded = clamp((depth(P) - mindistance) / max(maxdistance - mindistance, 1e-6), 0, 1);
    Ci = mix(Ci, background, faded);
    Oi = mix(Oi, color(1), faded);
}
