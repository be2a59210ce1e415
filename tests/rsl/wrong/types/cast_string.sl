surface x() { Ci = color("red"); }
//! 1:20 error RSL_TYPE_MISMATCH this is string
