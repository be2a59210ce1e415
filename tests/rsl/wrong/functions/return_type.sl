float f(color c) {
    return c * 2;
}
surface x() { Ci = f(Cs); }
//! 2:12 error RSL_TYPE_MISMATCH the result needs float
