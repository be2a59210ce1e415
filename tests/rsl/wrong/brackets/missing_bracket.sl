surface x() {
    float a[3];
    a[1 = 2;
    Ci = 1;
}
//! 3:12 error RSL_SYNTAX ']'
