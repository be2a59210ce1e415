surface x() { Ci = missing; }
surface y() { Ci = missing; }
//! 1:20 error RSL_UNKNOWN_VARIABLE 'missing'
//! 2:20 error RSL_UNKNOWN_VARIABLE 'missing'
