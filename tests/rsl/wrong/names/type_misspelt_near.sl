surface x() {
    vecter v = N;
    Ci = 1;
}
//! 2:5 error RSL_UNKNOWN_TYPE did you mean 'vector'?
