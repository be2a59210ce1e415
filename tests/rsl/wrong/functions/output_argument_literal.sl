void f(output float a) { a = 1; }
surface x() { f(1); Ci = 1; }
//! 2:17 error RSL_OUTPUT_ARGUMENT written to and must be a variable
