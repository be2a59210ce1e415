surface x() {
    float a[];
    color c[];
    a = c;
    Ci = a[0];
}
//! 4:9 error RSL_TYPE_MISMATCH 'a' needs float[], this is color[]
