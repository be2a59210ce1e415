float f(float x) { return x; }
surface x() { Ci = f; Oi = noise; }
//! 2:20 error RSL_UNKNOWN_VARIABLE it is a function, which is called as 'f(...)'
//! 2:28 error RSL_UNKNOWN_VARIABLE it is a function, which is called as 'noise(...)'
