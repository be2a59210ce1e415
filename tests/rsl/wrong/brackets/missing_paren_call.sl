surface x() {
    Ci = diffuse(normalize(N);
    Oi = 1;
}
//! 2:30 error RSL_SYNTAX expected ')' before ';'
