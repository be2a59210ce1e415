struct A { float k; }
struct B : C { float j; }
surface x() { Ci = 1; }
//! 2:12 error RSL_SYNTAX the name of a struct that is defined before
