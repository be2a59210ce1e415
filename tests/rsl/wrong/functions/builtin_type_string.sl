surface x() { Ci = length("abc"); }
//! 1:20 error RSL_NO_OVERLOAD no form of 'length' takes (string)
