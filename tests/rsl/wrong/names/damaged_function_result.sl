float f(float x) {
    if (x > 1 { return 1; }
    retrun x * ;
}
surface x() { Ci = f(s) * unknown; }
//! 2:15 error RSL_SYNTAX expected ')' before '{'
//! 3:12 error RSL_SYNTAX did you mean 'return'?
//! 5:27 error RSL_UNKNOWN_VARIABLE unknown variable 'unknown'
