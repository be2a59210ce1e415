surface x() { Ci = frac(s * 4); }
//! 1:20 error RSL_UNKNOWN_FUNCTION use mod(x, 1)
