surface x() { Ci = color(cross(N, I)); }
//! 1:26 error RSL_UNKNOWN_FUNCTION write 'a ^ b'
