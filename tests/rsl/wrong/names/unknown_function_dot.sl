surface x() { Ci = dot(N, I); }
//! 1:20 error RSL_UNKNOWN_FUNCTION write 'a . b'
