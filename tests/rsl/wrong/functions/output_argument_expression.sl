void f(output float a) { a = 1; }
surface x() { float b = 1; f(b + 1); Ci = b; }
//! 2:30 error RSL_OUTPUT_ARGUMENT argument 1 of 'f'
