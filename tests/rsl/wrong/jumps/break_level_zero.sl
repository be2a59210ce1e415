surface x() { while (s > 2) { break 0; } Ci = 1; }
//! 1:37 error RSL_ARGUMENT_FORM a whole number of loops
