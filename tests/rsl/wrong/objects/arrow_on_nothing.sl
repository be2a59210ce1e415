surface x() { Ci = nothing->tint; }
//! 1:20 error RSL_UNKNOWN_VARIABLE unknown variable 'nothing'
