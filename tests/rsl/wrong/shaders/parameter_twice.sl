surface x(float a = 1; color a = 1) { Ci = a; }
//! 1:30 error RSL_REDEFINED 'a' is already declared
