surface x() {
    Ci = mix(Cs, Os s);
}
//! 2:21 error RSL_SYNTAX before 's'
