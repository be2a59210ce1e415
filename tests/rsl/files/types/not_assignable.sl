surface x() {
    1 = 2;
    sin(s) = 1;
    (P + N) = I;
    Ci[0] = 1;
    Ci = 1;
}
//! 2:5 error RSL_NOT_ASSIGNABLE this cannot be assigned to
//! 3:5 error RSL_NOT_ASSIGNABLE this cannot be assigned to
//! 4:5 error RSL_NOT_ASSIGNABLE this cannot be assigned to
