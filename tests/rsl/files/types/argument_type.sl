float f(string name) { return 1; }
surface x() { Ci = f(P); }
//! 2:22 error RSL_TYPE_MISMATCH argument 1 of 'f' needs string, this is point
