surface x(color c = {1, 0, 0}) { Ci = c; }
//! 1:21 error RSL_ARRAY_AS_VALUE write (a, b, c)
