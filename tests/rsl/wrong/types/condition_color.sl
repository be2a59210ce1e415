surface x() { if (Cs) Ci = 1; }
//! 1:19 error RSL_CONDITION this is color
