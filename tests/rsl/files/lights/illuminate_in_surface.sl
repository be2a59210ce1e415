surface x() { illuminate(P) { Ci = 1; } }
light y() { illuminance(P) { Cl = 1; } }
//! 1:15 error RSL_STATEMENT_NOT_LEGAL illuminate cannot be used in surface shaders
//! 2:13 error RSL_STATEMENT_NOT_LEGAL illuminance cannot be used in light shaders
