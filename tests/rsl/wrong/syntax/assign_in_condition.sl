surface x() { float a = s; if (a = 1) Ci = 1; }
//! 1:34 warning RSL_ASSIGN_IN_CONDITION '==' compares
