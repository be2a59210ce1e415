light x() { illuminance(P) { Cl = 1; } }
//! 1:13 error RSL_STATEMENT_NOT_LEGAL illuminance cannot be used in light shaders
