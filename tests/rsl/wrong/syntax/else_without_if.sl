surface x() {
    Ci = 1;
    else Ci = 0;
}
//! 3:5 error RSL_SYNTAX before 'else'
