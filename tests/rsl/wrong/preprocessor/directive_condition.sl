#if 1 +
#endif
surface x() { Ci = 1; }
//! 1:5 error RSL_BAD_CONDITION constant expression
