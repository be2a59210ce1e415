surface x() { point q = setxcomp(P, 1); Ci = 1; }
//! 1:25 error RSL_VOID_VALUE 'setxcomp' returns nothing
