surface x() { Ci = texture("a", s, t, "blur"); }
//! 1:20 error RSL_NO_OVERLOAD "name", value
