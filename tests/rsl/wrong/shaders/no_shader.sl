float f(float a) { return a; }
//! 1:1 error RSL_NO_SHADER defines no shader
