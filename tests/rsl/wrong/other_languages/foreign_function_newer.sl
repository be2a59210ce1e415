surface x() {
    float n = hash(P, 1);
    Ci = n;
}
//! 2:15 error RSL_FOREIGN_FUNCTION 'hash' is a function of other renderers that is not supported
