surface x() {
    Ci = Cs * ;
}
//! 2:15 error RSL_SYNTAX expected an expression before ';'
