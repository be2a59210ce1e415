surface x(matrix a = 1) { matrix b = a + a; Ci = 1; }
//! 1:38 error RSL_BAD_OPERANDS '+' does not apply to matrix
