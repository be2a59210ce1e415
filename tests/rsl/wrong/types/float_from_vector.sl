surface x() {
    float a;
    a = normalize(N);
    Ci = a;
}
//! 3:9 error RSL_TYPE_MISMATCH length(v)
