surface x() {
    Ci = "red";
}
//! 2:10 error RSL_TYPE_MISMATCH this is string
