surface x(string name = "a";) {
    string b = name + "c";
    float f = name;
    Ci = f;
}
//! 2:16 error RSL_BAD_OPERANDS '+' does not apply to string and string
//! 3:15 error RSL_TYPE_MISMATCH 'f' needs float, this is string
