surface x() {
    if s > 0.5 Ci = 1;
    Oi = 1;
}
//! 2:8 error RSL_SYNTAX expected '('
