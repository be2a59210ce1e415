surface x(float n = 3) { float a[n]; Ci = a[0]; }
//! 1:34 error RSL_BAD_ARRAY_LENGTH whole number
