surface x() {
    Ci = color(1, N, 0);
}
//! 2:19 error RSL_TYPE_MISMATCH a component needs float
