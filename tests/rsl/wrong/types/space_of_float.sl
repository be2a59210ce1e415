surface x() { float a = float "world" (s); Ci = a; }
//! 1:25 error RSL_BAD_SPACE no coordinate system
