surface x() { Ci = color (1, 0); }
//! 1:26 error RSL_ARGUMENT_FORM 3 numbers
