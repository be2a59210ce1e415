surface x() {
    color c = Cs
    c *= 2
    Ci = c;
}
//! 2:17 error RSL_SYNTAX expected ';'
//! 3:11 error RSL_SYNTAX expected ';'
