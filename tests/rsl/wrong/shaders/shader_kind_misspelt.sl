surfce x() { Ci = 1; }
//! 1:1 error RSL_SYNTAX did you mean 'surface'?
