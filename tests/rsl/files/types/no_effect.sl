surface x() {
    s == t;
    Ci;
    Ci = 1;
}
//! 2:5 warning RSL_NO_EFFECT statement has no effect
//! 3:5 warning RSL_NO_EFFECT statement has no effect
