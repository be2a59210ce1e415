surface x() { Ci = Cs }
//! 1:22 error RSL_SYNTAX expected ';' before '}'
