surface x() {
    float on = true;
    Ci = on;
}
//! 2:16 error RSL_UNKNOWN_VARIABLE write '1'
