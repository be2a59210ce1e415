f(a, float b) { return a + b; }
surface x(Kd = 1, Ks = 2; color c = 0) { Ci = f(Kd, Ks) * c; }
//! 1:3 warning RSL_MISSING_TYPE parameter 'a' has no type; float is assumed
//! 2:11 warning RSL_MISSING_TYPE parameter 'Kd' has no type; float is assumed
