surface x() { Ci = difuse(N); }
//! 1:20 error RSL_UNKNOWN_FUNCTION did you mean 'diffuse'?
