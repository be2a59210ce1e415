light x() { illuminate(P, N) { Cl = 1; } }
//! 1:13 error RSL_ARGUMENT_FORM (position) or (position, axis, angle)
