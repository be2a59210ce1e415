surface x() { if (Cs > 0.5) Ci = 1; }
//! 1:19 warning RSL_TRIPLE_ORDER all three components
