surface x(matrix m = 1) { point q = m * P; Ci = 1; }
//! 1:37 error RSL_BAD_OPERANDS transform(m, p)
