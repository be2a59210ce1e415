surface x() { Ci = atan2(s, t); }
//! 1:20 error RSL_UNKNOWN_FUNCTION use atan(y, x)
