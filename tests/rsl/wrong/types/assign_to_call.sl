surface x() { xcomp(P) = 1; Ci = 1; }
//! 1:15 error RSL_NOT_ASSIGNABLE setxcomp
