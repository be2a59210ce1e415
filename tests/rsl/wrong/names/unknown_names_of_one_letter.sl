surface x() {
    float q = length(Pp) + noiz(P);
    Ci = z * q;
}
//! 2:22 error RSL_UNKNOWN_VARIABLE did you mean 'P'?
//! 2:28 error RSL_UNKNOWN_FUNCTION did you mean 'noise'?
//! 3:10 error RSL_UNKNOWN_VARIABLE unknown variable 'z'
