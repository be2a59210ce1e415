float falloff(float x) { return x * x; }
surface x() { Ci = fallof(s); }
//! 2:20 error RSL_UNKNOWN_FUNCTION did you mean 'falloff'?
