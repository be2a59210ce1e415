float f(float x) {
    retrun x;
}
surface x() { Ci = f(s); }
//! 2:12 error RSL_SYNTAX did you mean 'return'?
