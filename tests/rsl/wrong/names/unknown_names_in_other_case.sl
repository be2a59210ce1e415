surface x() {
    Ci = Color(1, 1, 1) * os;
    Oi = sIn(s) * n.I;
}
//! 2:10 error RSL_UNKNOWN_FUNCTION did you mean 'color'?
//! 2:27 error RSL_UNKNOWN_VARIABLE did you mean 'Os'?
//! 3:10 error RSL_UNKNOWN_FUNCTION did you mean 'sin'?
//! 3:19 error RSL_UNKNOWN_VARIABLE did you mean 'N'?
