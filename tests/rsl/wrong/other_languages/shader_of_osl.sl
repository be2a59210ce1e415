shader x(int n = 1) { Ci = n; }
//! 1:10 error RSL_UNKNOWN_TYPE
