struct Sample { color tint; }
surface x() {
    Sample a;
    a->tint = "red";
    Ci = a->tint;
}
//! 4:15 error RSL_TYPE_MISMATCH 'a->tint' needs color, this is string
