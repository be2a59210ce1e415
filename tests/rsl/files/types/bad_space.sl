surface x() {
    float a = float "world" s;
    point p = point "world" (0, 0, 0);
    Ci = a * ctransform("hsv", color p);
}
//! 2:15 error RSL_BAD_SPACE a float has no coordinate system
