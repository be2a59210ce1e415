surface x() { float a[3]; Ci = a; }
//! 1:32 error RSL_ARRAY_AS_VALUE whole array
