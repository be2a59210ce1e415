surface x(string a = "tex") {
    string b = a + ".tx";
    Ci = 1;
}
//! 2:16 error RSL_BAD_OPERANDS concat
