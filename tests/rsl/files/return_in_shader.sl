surface x() {
    Ci = 1;
    return;
}
//! 3:5 error RSL_RETURN_OUTSIDE_FUNCTION return outside a function
