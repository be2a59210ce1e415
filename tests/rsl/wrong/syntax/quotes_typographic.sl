surface x(string a = “wood”; float b = 1) {
    Ci = b – 1;
}
//! 1:22 error RSL_BAD_CHARACTER write a plain "
//! 2:12 error RSL_BAD_CHARACTER write a plain -
