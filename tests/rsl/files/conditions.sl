surface x(string name = "";) {
    if (P) Ci = 1;
    while (name) Ci = 2;
    Ci = N < I ? 1 : 2;
    if (Ci = 1) Ci = 2;
    if ((Ci = 1) == 1) Ci = 2;
}
//! 5:12 warning RSL_ASSIGN_IN_CONDITION '=' assigns; '==' compares
//! 2:9 error RSL_CONDITION a condition is a comparison or a float, this is point
//! 3:12 error RSL_CONDITION a condition is a comparison or a float, this is string
//! 4:10 error RSL_BAD_OPERANDS '<' does not apply to normal and vector
//! 5:9 error RSL_CONDITION a condition is a comparison or a float, this is color
