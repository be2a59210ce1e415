/* sunset.sl: a low sun of some size: its warm light comes from a disc, and its shadows soften.
   Parameters: intensity, lightcolor, discsize: half the sun's angle in degrees. */
light sunset(float intensity = 1.3; color lightcolor = color(1, 0.52, 0.22); float discsize = 2;
             point from = point "shader" (0, 0, 0); point to = point "shader" (0, 0, 1);) {
    uniform vector axis = normalize(to - from);
    uniform vector side = normalize(axis ^ vector(0.31, 0.83, 0.46));
    uniform vector top = axis ^ side;
    float r = tan(radians(discsize)) * sqrt(float random());
    float a = 2 * PI * float random();
    solar(axis + r * (cos(a) * side + sin(a) * top), 0.0) {
        Cl = intensity * lightcolor;
    }
}
