surface x() {
    Ci = 1;
}
}
surface y() { Ci = 0; }
//! 4:1 error RSL_SYNTAX before '}'
