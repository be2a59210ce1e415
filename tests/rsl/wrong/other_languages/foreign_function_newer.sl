surface x() {
    float n = wnoise(P, 1);
    Ci = n;
}
//! 2:15 error RSL_FOREIGN_FUNCTION 'wnoise' is a function of other renderers that is not supported
