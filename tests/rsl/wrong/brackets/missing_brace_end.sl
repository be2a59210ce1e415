surface x() {
    if (s > 0.5) {
        Ci = 1;
    Oi = 1;
}
//! 1:13 error RSL_UNCLOSED '{' is never closed
