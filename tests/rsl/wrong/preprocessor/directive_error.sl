#error use another shader
surface x() { Ci = 1; }
//! 1:2 error RSL_ERROR_DIRECTIVE use another shader
