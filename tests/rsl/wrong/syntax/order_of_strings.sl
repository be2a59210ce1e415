surface x(string a = "tex") { if (a < "b") Ci = 1; }
//! 1:35 error RSL_BAD_OPERANDS '<' does not apply
