surface x() {
    int i = 0;
    Ci = i;
}
//! 2:5 error RSL_UNKNOWN_TYPE write 'float'
