float f(float a) { float b = a; }
surface x() { Ci = f(s); }
//! 1:7 warning RSL_MISSING_RETURN never returns a value
