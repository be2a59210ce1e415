surface x() {
    float a[];
    Ci = 1;
}
//! 2:11 error RSL_UNSIZED_ARRAY RSL 2.0
