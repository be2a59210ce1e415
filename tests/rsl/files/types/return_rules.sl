void f(float a) { return a; }
float g(float a) { return; }
color h(float a) { return "red"; }
float k(float a) { float b = a; }
surface x() { f(1); Ci = g(1) + h(2) + k(1); }
//! 1:19 error RSL_RETURN_VALUE void function 'f' returns a value
//! 2:20 error RSL_RETURN_NOTHING return needs a float value
//! 3:27 error RSL_TYPE_MISMATCH the result needs color, this is string
//! 4:7 warning RSL_MISSING_RETURN function 'k' never returns a value; its result is 0
