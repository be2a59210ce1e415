surface x() {
    if (s > 0.5);
        Ci = 1;
    else
        Ci = 0;
    Oi = Ci;
}
//! 4:5 error RSL_SYNTAX a ';' or a missing brace parts them
