surface x() {
    float i;
    if (s > ) Ci = 1; else Ci = 2;
    for (i = 0; i 3; i += 1) { Ci += nosuch; }
    while (i < 3 3) i += 1;
    if (s > 0.5) Ci = 1 1; else Ci = 2;
    if (s > 0.5 Ci = 1; else Ci = 2;
    for (float k = ; k < 2; k += 1) Ci += k;
}
//! 3:13 error RSL_SYNTAX expected an expression
//! 4:19 error RSL_SYNTAX expected ';'
//! 5:18 error RSL_SYNTAX expected ')'
//! 6:25 error RSL_SYNTAX expected ';'
//! 7:17 error RSL_SYNTAX expected ')'
//! 8:20 error RSL_SYNTAX expected an expression
//! 4:38 error RSL_UNKNOWN_VARIABLE nosuch
