surface x() {
    for (int i = 0; i < 3; i += 1) Ci += i * Cs;
}
//! 2:10 error RSL_UNKNOWN_TYPE write 'float'
