surface x() {
    matrix m = P;
    Ci = 1;
}
//! 2:16 error RSL_TYPE_MISMATCH translate(1, v)
