surface x() {
    float a = P;
    float b = (1, 2, 3);
    Ci = a + b;
}
//! 2:15 error RSL_TYPE_MISMATCH 'a' needs float, this is point
//! 3:15 error RSL_TYPE_MISMATCH 'b' needs float, this is point
