surface x() { Ci = s . t; }
//! 1:20 error RSL_BAD_OPERANDS '.' does not apply to float and float
