struct Sample { color tint; }
surface x() {
    Sample a;
    Ci = a;
}
//! 4:10 error RSL_STRUCT_AS_VALUE a whole struct cannot be used here
