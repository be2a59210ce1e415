surface x() { Ci = arraylength(s); }
//! 1:20 error RSL_NO_OVERLOAD no form of 'arraylength' takes (float)
