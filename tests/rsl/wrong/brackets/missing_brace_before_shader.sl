surface x() {
    if (s > 0.5) {
        Ci = 1;
    Oi = 1;
}
surface y() { Ci = 1 }
//! 1:13 error RSL_UNCLOSED before surface 'y'
//! 6:21 error RSL_SYNTAX expected ';'
