float f(float a) { return a; }
float f(string a) { return 1; }
surface x() { Ci = f(Cs); }
//! 3:20 error RSL_NO_OVERLOAD float f(float), float f(string)
