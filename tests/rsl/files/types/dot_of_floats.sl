surface x() {
    float a = 1 . 2;
    vector b = s ^ N;
    matrix m = 1;
    m = m + m;
    m = m * m / 2;
    Ci = a * N . N;
}
//! 2:15 error RSL_BAD_OPERANDS '.' does not apply to float and float
//! 3:16 error RSL_BAD_OPERANDS '^' does not apply to float and normal
//! 5:9 error RSL_BAD_OPERANDS '+' does not apply to matrix and matrix
