surface x(float a[2] = {1, 2};) {
    Ci = urandom();
    Ci = getvar(a) + unknown;
}
//! 2:10 error RSL_FOREIGN_FUNCTION 'urandom' is a function of Pixie that is not supported
//! 3:10 error RSL_2 'getvar()' belongs to the part of RSL 2.0
