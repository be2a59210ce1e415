surface x(float a = 1; {
    Ci = a;
}
//! 1:23 error RSL_SYNTAX expected ')' before '{'
