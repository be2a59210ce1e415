surface x() { Ci = tan(Cs); }
//! 1:20 error RSL_NO_OVERLOAD no form of 'tan' takes (color)
