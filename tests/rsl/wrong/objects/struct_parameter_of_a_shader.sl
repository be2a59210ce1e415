struct A { float k; }
surface x(A a;) { Ci = a->k; }
//! 2:13 error RSL_2 a parameter of a shader that is a struct
