surface x(string a = "tex") { if (a == 1) Ci = 1; }
//! 1:35 error RSL_BAD_OPERANDS '==' does not apply to string and float
