surface x() { Ci = sin(s * M_PI); }
//! 1:28 error RSL_UNKNOWN_VARIABLE PI
