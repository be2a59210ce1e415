surface x() {
    float r = 1;
    Ci = P.y + Cs.g;
    Ci *= P.r;
}
//! 3:12 error RSL_NOT_RSL write ycomp(p)
//! 3:19 error RSL_NOT_RSL write comp(c, 1)
//! 4:11 error RSL_BAD_OPERANDS '.' does not apply to point and float
