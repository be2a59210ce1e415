surface x() { Ci = sin(Cs); }
//! 1:20 error RSL_NO_OVERLOAD no form of 'sin' takes (color)
