surface x() {
    Ci = Cs \ 2;
}
//! 2:13 error RSL_BAD_CHARACTER unexpected
