surface x() {
    Ci = (Cs * 2));
}
//! 2:18 error RSL_SYNTAX ')'
