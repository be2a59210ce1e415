surface x() {
    string a = 1;
    Ci = 1;
}
//! 2:16 error RSL_TYPE_MISMATCH format("%f", x)
