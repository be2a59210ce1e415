float f(float x) {
    while (x > 1) { braek; }
    retrun;
}
surface x() { Ci = f(s); }
//! 2:21 error RSL_UNKNOWN_VARIABLE did you mean 'break'?
//! 3:5 error RSL_UNKNOWN_VARIABLE did you mean 'return'?
