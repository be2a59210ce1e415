surface x(matrix m = 1) { Ci = m[0]; }
//! 1:32 error RSL_NOT_ARRAY comp(m, row, column)
