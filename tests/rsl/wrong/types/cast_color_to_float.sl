surface x() { Ci = float(Cs); }
//! 1:20 error RSL_TYPE_MISMATCH comp(c, 0)
