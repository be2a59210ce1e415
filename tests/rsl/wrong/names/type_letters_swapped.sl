surface x() {
    flaot a = 1;
    Ci = a;
}
//! 2:5 error RSL_UNKNOWN_TYPE did you mean 'float'?
