surface x() { float a[3], b[3]; Ci = (a + b)[0]; }
//! 1:39 error RSL_ARRAY_AS_VALUE whole array
//! 1:43 error RSL_ARRAY_AS_VALUE whole array
