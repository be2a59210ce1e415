surface x() {
    color c = Cs;
    Ci = c->r;
}
//! 3:10 error RSL_NOT_STRUCT '->' needs a struct, and 'c' is none
