surface x() { void(Cs); Ci = 1; }
//! 1:15 error RSL_BAD_OPERAND 'void' does not apply
