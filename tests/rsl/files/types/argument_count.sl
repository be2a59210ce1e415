float f(float a, b; color c) { return a + b + comp(c, 0); }
surface x() {
    Ci = f(1, 2);
}
//! 3:10 error RSL_ARGUMENT_COUNT 'f' takes 3 argument(s), 2 given
