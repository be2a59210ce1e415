surface x() { Ci = texture(s, t); }
//! 1:20 error RSL_NO_OVERLOAD no form of 'texture' takes (float, float)
