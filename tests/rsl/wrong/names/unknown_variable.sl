surface x() { Ci = Kdd; }
//! 1:20 error RSL_UNKNOWN_VARIABLE unknown variable 'Kdd'
