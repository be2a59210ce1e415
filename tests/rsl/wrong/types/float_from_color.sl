surface x() {
    float a = Cs;
    Ci = a;
}
//! 2:15 error RSL_TYPE_MISMATCH take a component: comp(c, 0)
