surface x() {
    float a = 1
    Ci = a;
}
//! 2:16 error RSL_SYNTAX expected ';'
