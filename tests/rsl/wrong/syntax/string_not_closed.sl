surface x(string a = "wood;) {
    Ci = 1;
}
//! 1:22 error RSL_UNTERMINATED_STRING closing quote
