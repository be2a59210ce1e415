surface x() {
    const float a = 1;
    Ci = a;
}
//! 2:5 error RSL_UNKNOWN_TYPE write 'uniform'
