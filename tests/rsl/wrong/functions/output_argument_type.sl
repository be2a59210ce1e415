void f(output float a) { a = 1; }
surface x() { color c; f(c); Ci = c; }
//! 2:26 error RSL_OUTPUT_TYPE must be a variable of type float, this is color
