surface x() {
    float a[];
    resize(a, "3");
    Ci = a[0];
}
//! 3:5 error RSL_NO_OVERLOAD no form of 'resize' takes (float[], string)
