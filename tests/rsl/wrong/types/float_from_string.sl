surface x(string name = "1") {
    float a = name;
    Ci = a;
}
//! 2:15 error RSL_TYPE_MISMATCH this is string
