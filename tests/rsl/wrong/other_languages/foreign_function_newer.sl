surface x() {
    float n = emit(Cs);
    Ci = n;
}
//! 2:15 error RSL_FOREIGN_FUNCTION 'emit' is a function of PRMan that is not supported
