float f(float a) { return a; }
surface x() { Ci = f(Cs); }
//! 2:22 error RSL_TYPE_MISMATCH argument 1 of 'f' needs float, this is color
