struct A { float k; }
struct B : A { float j; }
surface x() { Ci = 1; }
//! 2:12 error RSL_2 a struct that inherits from another
