surface x(string a = "tex") { string b = -a; Ci = 1; }
//! 1:42 error RSL_BAD_OPERAND '-' does not apply to string
