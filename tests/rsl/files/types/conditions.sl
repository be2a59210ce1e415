surface x(string name = "";) {
    if (P) Ci = 1;
    while (name) Ci = 2;
    Ci = N < I ? 1 : 2;
    if (Ci = 1) Ci = 2;
    if ((Ci = 1) == 1) Ci = 2;
}
//! 5:12 warning RSL_ASSIGN_IN_CONDITION '=' assigns; '==' compares
//! 2:9 error RSL_CONDITION a condition is a comparison or a float, this is point
//! 3:12 warning RSL_STRING_CONDITION taken as != ""
//! 4:10 warning RSL_TRIPLE_ORDER '<' of vectors
//! 5:9 error RSL_CONDITION a condition is a comparison or a float, this is color
