surface x() { Ci = saturate(s * 4); }
//! 1:20 error RSL_UNKNOWN_FUNCTION use clamp(x, 0, 1)
