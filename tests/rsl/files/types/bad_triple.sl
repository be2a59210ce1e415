surface x() {
    Ci = (1, 2);
    P = (1, "a", 3);
}
//! 2:10 error RSL_ARGUMENT_FORM (...) takes 3 numbers for a triple or 16 for a matrix
//! 3:13 error RSL_TYPE_MISMATCH a component needs float, this is string
