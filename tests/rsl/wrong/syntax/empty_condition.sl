surface x() {
    if () Ci = 1;
}
//! 2:9 error RSL_SYNTAX expected an expression
