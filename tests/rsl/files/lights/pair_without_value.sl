surface x() {
    Ci = color texture("a.tif", s, t, "blur");
}
//! 2:16 error RSL_NO_OVERLOAD no form of 'texture' takes (string, float, float, string)
