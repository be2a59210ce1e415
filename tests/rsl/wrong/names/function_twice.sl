float f(float a) { return a; }
float f(float b) { return b; }
surface x() { Ci = f(1); }
//! 2:7 warning RSL_FUNCTION_REDEFINED the later one is used
