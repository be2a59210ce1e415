surface x() {
    float a[3];
    resize(a, 4);
    Ci = a[0];
}
//! 3:12 error RSL_NOT_RESIZABLE the length of array 'a' is fixed
