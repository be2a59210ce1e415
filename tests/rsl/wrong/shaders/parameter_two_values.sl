float f(float) { return 1; }
surface x(float a = 1 1; float b = 2 * , c = 3) { Ci = a * b * c * f(2); }
//! 1:14 error RSL_SYNTAX variable name
//! 2:23 error RSL_SYNTAX ',' or ')'
//! 2:40 error RSL_SYNTAX expected an expression
