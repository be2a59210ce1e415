surface x() {
    if (s > 0.5) { Ci = 1; }}
    Oi = 1;
}
surface y() { Ci = 1; }
//! 3:5 error RSL_SYNTAX one too many
