surface x() {
    Ci = s > 0.5 ? Cs , Os;
}
//! 2:23 error RSL_SYNTAX expected ':'
