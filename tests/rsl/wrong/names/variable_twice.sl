surface x() { float a = 1; float a = 2; Ci = a; }
//! 1:34 warning RSL_REDECLARED this one hides it
