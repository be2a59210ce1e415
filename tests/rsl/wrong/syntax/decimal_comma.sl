surface x(float a = 0,5; float b = 1) { Ci = a * b; }
//! 1:23 error RSL_SYNTAX did you mean '0.5'?
