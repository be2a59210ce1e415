surface x(matrix m = 1) { while (m) Ci = 1; }
//! 1:34 error RSL_CONDITION this is matrix
