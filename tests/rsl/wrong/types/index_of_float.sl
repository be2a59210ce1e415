surface x() { float a = 1; Ci = a[0]; }
//! 1:33 error RSL_NOT_ARRAY this is float
