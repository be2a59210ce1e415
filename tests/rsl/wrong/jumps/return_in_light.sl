light x() { Cl = 1; return; }
//! 1:21 error RSL_RETURN_OUTSIDE_FUNCTION outside a function
