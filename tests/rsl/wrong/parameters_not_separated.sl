surface x(float a = 1 float b = 2) { Ci = a * b; }
//! 1:23 error RSL_SYNTAX ',' or ')'
