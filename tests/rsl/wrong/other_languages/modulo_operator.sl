surface x() {
    Ci = s % 2;
}
//! 2:12 error RSL_NOT_RSL write 'mod(a, b)'
