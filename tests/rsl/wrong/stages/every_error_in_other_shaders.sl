surface first() { Ci = unknownq(s); Oi = difuse(N); }
surface second() { Ci = length(I; }
surface third() {
    Ci = unknownthing;
    Oi = Oss;
}
//! 2:33 error RSL_SYNTAX expected ')' before ';'
//! 1:24 error RSL_UNKNOWN_FUNCTION unknown function 'unknownq'
//! 1:42 error RSL_UNKNOWN_FUNCTION did you mean 'diffuse'?
//! 4:10 error RSL_UNKNOWN_VARIABLE unknown variable 'unknownthing'
//! 5:10 error RSL_UNKNOWN_VARIABLE did you mean 'Os'?
