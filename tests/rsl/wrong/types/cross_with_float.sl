surface x() { Ci = color(N ^ 2); }
//! 1:25 error RSL_BAD_OPERANDS '^' does not apply
