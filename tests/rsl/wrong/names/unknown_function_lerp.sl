surface x() { Ci = lerp(Cs, Os, 0.5); }
//! 1:20 error RSL_UNKNOWN_FUNCTION use mix(a, b, x)
