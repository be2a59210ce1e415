surface x(float = 1) { Ci = 1; }
//! 1:17 error RSL_SYNTAX variable name
