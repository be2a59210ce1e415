float f(uniform float a) { return a; }
surface x() { Ci = f(s); }
//! 2:22 warning RSL_UNIFORM_ARGUMENT uniform parameter 'a' of 'f'
