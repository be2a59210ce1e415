surface x() {
    if (s > .5 { Ci = inside; }
    Ci = (1 + ;
    color c = difuse(N);
    Oi = Oss * c;
}
//! 2:16 error RSL_SYNTAX expected ')' before '{'
//! 3:15 error RSL_SYNTAX expected an expression before ';'
//! 2:23 error RSL_UNKNOWN_VARIABLE unknown variable 'inside'
//! 4:15 error RSL_UNKNOWN_FUNCTION did you mean 'diffuse'?
//! 5:10 error RSL_UNKNOWN_VARIABLE did you mean 'Os'?
