surface x() {
    float a = nosuch(P) * 2;
    color c = nosuch(a) + other(Cs);
    Ci = c * a;
}
//! 2:15 error RSL_UNKNOWN_FUNCTION 'nosuch'
//! 3:27 error RSL_UNKNOWN_FUNCTION 'other'
