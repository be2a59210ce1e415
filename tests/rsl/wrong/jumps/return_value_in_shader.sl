surface x() { Ci = 1; return Cs; }
//! 1:23 error RSL_RETURN_OUTSIDE_FUNCTION outside a function
