surface x() {
    float a = 1 +;
    float c = 2;
    if (c > ) { Ci = 1; }
    Ci = c;
}
//! 2:18 error RSL_SYNTAX expected an expression before ';'
//! 4:13 error RSL_SYNTAX expected an expression before ')'
