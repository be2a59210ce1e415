surface x() { Ci = Cs->r; Oi = nothing; }
//! 1:22 error RSL_2 '->'
