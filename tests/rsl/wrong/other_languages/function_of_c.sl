int f(float a) { return a + missing; }
surface x() { Ci = f(1); }
//! 1:1 error RSL_UNKNOWN_TYPE write 'float'
//! 1:29 error RSL_UNKNOWN_VARIABLE 'missing'
