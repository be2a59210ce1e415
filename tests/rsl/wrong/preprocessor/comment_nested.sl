surface x() {
    /* Ci = Cs; /* the base */ Oi = Os; */
    Ci = 1;
}
//! 2:41 error RSL_SYNTAX comments do not nest
