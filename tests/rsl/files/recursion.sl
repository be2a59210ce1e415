float f(float a) { return g(a - 1); }
float g(float a) { return f(a); }
surface x() { Ci = f(1); }
//! 1:27 error RSL_RECURSION function 'g' calls itself; recursion is not supported yet
