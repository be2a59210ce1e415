surface x() { illuminate(P) { Ci = 1; } }
//! 1:15 error RSL_STATEMENT_NOT_LEGAL illuminate cannot be used in surface shaders
