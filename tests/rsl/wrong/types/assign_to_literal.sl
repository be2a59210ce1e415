surface x() { 1 = s; Ci = 1; }
//! 1:15 error RSL_NOT_ASSIGNABLE cannot be assigned to
