surface x() { float a[2], b[3]; a = b; Ci = a[0]; }
//! 1:37 error RSL_TYPE_MISMATCH needs float[2], this is float[3]
