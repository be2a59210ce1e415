surface x() { Ci = clamp(s, 1); }
//! 1:20 error RSL_NO_OVERLOAD float clamp(float, float, float)
