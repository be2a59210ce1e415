surface x() {
    float a[3];
    Ci = a[P];
}
//! 3:12 error RSL_TYPE_MISMATCH an index needs float
