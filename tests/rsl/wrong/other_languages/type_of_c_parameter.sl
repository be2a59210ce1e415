surface x(double a = 1) { Ci = a; }
//! 1:11 error RSL_UNKNOWN_TYPE write 'float'
