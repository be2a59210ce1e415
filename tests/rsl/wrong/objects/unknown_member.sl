struct Sample { color tint; float weight; }
surface x() {
    Sample a;
    Ci = a->tnit;
}
//! 4:10 error RSL_NO_MEMBER struct 'Sample' has no member 'tnit'
