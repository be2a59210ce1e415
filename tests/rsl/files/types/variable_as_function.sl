surface x(string space = "shader"; float freq = 2) {
    point p = point space (1, 2, 3);
    Ci = freq(2) * color(p);
}
//! 2:21 error RSL_UNKNOWN_FUNCTION it is a variable; write 'transform(space, (x, y, z))'
//! 3:10 error RSL_UNKNOWN_FUNCTION it is a variable, which cannot be called
