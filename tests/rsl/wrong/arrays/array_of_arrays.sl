surface x() {
    float a[2][3];
    Ci = 1;
}
//! 2:15 error RSL_NOT_RSL use one index
