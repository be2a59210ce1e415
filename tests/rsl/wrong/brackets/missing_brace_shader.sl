surface x() Ci = 1;
//! 1:12 error RSL_SYNTAX expected '{' before 'Ci'
