surface x() { Ci = s > 0.5 ? Cs : "red"; }
//! 1:20 error RSL_BAD_OPERANDS color and string
