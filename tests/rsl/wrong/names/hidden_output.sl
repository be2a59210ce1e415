surface x() { color Ci = 0; Ci += Cs; }
//! 1:21 warning RSL_HIDES_OUTPUT hides the shader's own
