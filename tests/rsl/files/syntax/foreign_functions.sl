surface x(float a[2] = {1, 2};) {
    Ci = urandom();
    Ci = arraylength(a) + unknown;
}
//! 2:10 error RSL_FOREIGN_FUNCTION 'urandom' is a function of Pixie that is not supported
//! 3:10 error RSL_2 'arraylength()' belongs to RSL 2.0
