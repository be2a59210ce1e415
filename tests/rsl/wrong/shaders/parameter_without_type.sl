surface x(Kd = 1) { Ci = Kd; }
//! 1:11 warning RSL_MISSING_TYPE float is assumed
