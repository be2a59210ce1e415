surface x() {
    bool on = 1;
    if (on) Ci = 1;
}
//! 2:5 error RSL_UNKNOWN_TYPE write 'float'
