surface x() { float a[2] = {1, 2, 3}; Ci = a[0]; }
//! 1:28 error RSL_ARRAY_LENGTH 3 values for an array of 2
