surface x() { Ci = irradiance(P, N, 64); }
//! 1:20 error RSL_FOREIGN_FUNCTION other renderers
