surface x(float a[2] = {1, 2};) {
    Ci = arraylength(a) + urandom();
}
//! 2:10 error RSL_FOREIGN_FUNCTION 'arraylength' is a function of RSL 2.0 that is not supported
//! 2:27 error RSL_FOREIGN_FUNCTION 'urandom' is a function of Pixie that is not supported
