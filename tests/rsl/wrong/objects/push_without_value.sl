surface x() {
    float a[];
    push(a);
    Ci = a[0];
}
//! 3:5 error RSL_NO_OVERLOAD no form of 'push' takes (float[])
