surface x(matrix m = 1) {
    float a = m;
    Ci = a;
}
//! 2:15 error RSL_TYPE_MISMATCH comp(m, row, column)
