surface x(float a = 1);
surface y() { Ci = 1; }
//! 1:23 error RSL_SYNTAX expected '{'
