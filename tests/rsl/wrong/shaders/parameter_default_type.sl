surface x(float a = "one"; color c = "red") { Ci = a * c; }
//! 1:21 error RSL_TYPE_MISMATCH 'a' needs float
//! 1:38 error RSL_TYPE_MISMATCH 'c' needs color
