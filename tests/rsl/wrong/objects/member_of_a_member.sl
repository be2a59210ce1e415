struct Sample { color tint; }
surface x() {
    Sample a;
    Ci = a->tint->red;
}
//! 4:10 error RSL_NOT_STRUCT '->' needs a struct, and 'a->tint' is none
