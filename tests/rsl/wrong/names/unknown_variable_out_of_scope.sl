surface x() {
    if (s > 0.5) { float inner = 1; }
    Ci = inner;
}
//! 3:10 error RSL_UNKNOWN_VARIABLE 'inner'
