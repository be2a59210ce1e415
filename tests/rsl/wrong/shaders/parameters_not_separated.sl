surface x(float a = 1 float b = 2) { Ci = a * b; }
//! 1:22 error RSL_SYNTAX expected ';' before 'float'
