surface x() { Ci = {1, 0, 0}; }
//! 1:20 error RSL_SYNTAX expected an expression before '{'
