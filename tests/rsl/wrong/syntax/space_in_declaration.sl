surface x(point "world" from = (0, 0, 1); float a = 1) {
    color "hsv" c = (0.5, 1, 1);
    Ci = c * a * length(from);
}
//! 1:17 error RSL_NOT_RSL before the value
//! 2:11 error RSL_NOT_RSL a space in a declaration
