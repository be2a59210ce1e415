float f() { return; }
surface x() { Ci = f(); }
//! 1:13 error RSL_RETURN_NOTHING needs a float value
