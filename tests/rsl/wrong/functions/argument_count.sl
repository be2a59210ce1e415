float f(float a, b) { return a + b; }
surface x() { Ci = f(1); }
//! 2:20 error RSL_ARGUMENT_COUNT 'f' takes 2 argument(s), 1 given
