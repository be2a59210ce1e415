surface x() { Ci = diffus(N); }
//! 1:20 error RSL_UNKNOWN_FUNCTION did you mean 'diffuse'?
