surface x() { ci = Cs; }
//! 1:15 error RSL_UNKNOWN_VARIABLE did you mean 'Ci'?
