surface x() { Ci = Cs * alpha; }
//! 1:25 warning RSL_GLOBAL_NOT_READABLE 'alpha'
