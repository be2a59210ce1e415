surface x() { void a; Ci = 1; }
//! 1:20 error RSL_VOID_VARIABLE cannot be void
