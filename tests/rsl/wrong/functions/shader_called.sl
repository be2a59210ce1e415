surface base(float K = 1) { Ci = K; }
surface x() { base(2); }
//! 2:15 error RSL_UNKNOWN_FUNCTION 'base' is a surface shader
