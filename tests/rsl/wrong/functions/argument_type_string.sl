float f(string a) { return 1; }
surface x() { Ci = f(2); }
//! 2:22 error RSL_TYPE_MISMATCH argument 1 of 'f' needs string
