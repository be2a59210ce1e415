surface x() { Ci = 1e39; }
//! 1:20 warning RSL_BAD_NUMBER out of range
