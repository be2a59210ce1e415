surface x() {
    string a[];
    float k = pop(a);
    Ci = k;
}
//! 3:15 error RSL_TYPE_MISMATCH 'k' needs float, this is string
