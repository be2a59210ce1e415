surface x() {
    colour c = Cs;
    Ci = c;
}
//! 2:5 error RSL_UNKNOWN_TYPE write 'color'
