float f(float a = 1; float b) { return a * b; }
surface x() { Ci = f(); }
//! 2:20 error RSL_ARGUMENT_COUNT 'f' takes 2 argument(s), 0 given
