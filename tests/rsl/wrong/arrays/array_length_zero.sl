surface x() { float a[0]; Ci = 1; }
//! 1:23 error RSL_BAD_ARRAY_LENGTH 1 or more
