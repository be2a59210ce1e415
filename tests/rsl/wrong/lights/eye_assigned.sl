surface x() { E = P; Ci = 1; }
//! 1:15 warning RSL_GLOBAL_NOT_WRITABLE 'E' cannot be assigned
