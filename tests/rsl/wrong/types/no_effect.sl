surface x() { Ci == Cs; Ci = 1; }
//! 1:15 warning RSL_NO_EFFECT no effect
