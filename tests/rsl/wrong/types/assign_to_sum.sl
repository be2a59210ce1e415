surface x() { float a, b; a + b = 1; Ci = a; }
//! 1:27 error RSL_NOT_ASSIGNABLE cannot be assigned to
