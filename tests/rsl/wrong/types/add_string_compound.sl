surface x(string a = "tex") {
    string b = "a";
    b += a;
    Ci = 1;
}
//! 3:5 error RSL_BAD_OPERANDS '+=' does not apply
