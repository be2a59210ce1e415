float f(float a) { return a * s; }
surface x() { uniform float a = f(2); Ci = a; }
//! 2:33 error RSL_UNIFORM_FROM_VARYING uniform 'a'
