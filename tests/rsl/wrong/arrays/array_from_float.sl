surface x() { float a[2] = 1; Ci = a[0]; }
//! 1:28 error RSL_TYPE_MISMATCH needs float[2]
