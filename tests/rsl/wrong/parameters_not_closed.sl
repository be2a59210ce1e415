surface x(float a = 1; {
    Ci = a;
}
//! 1:24 error RSL_SYNTAX before '{'
