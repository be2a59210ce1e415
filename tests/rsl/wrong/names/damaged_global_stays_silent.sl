surface x() {
    float N = (1 + ;
    float a = N;
    Ci = a;
}
surface y() {
    float a = N;
    Ci = a;
}
//! 2:20 error RSL_SYNTAX expected an expression before ';'
//! 7:15 error RSL_TYPE_MISMATCH take a component, as xcomp(p), or length(v)
