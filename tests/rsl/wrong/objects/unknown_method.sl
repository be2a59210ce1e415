struct Sample { color tint; void init() { tint = 1; } }
surface x() {
    Sample a;
    a->inti();
    Ci = a->tint;
}
//! 4:5 error RSL_NO_METHOD struct 'Sample' has no method 'inti'
