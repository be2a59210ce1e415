surface x() { uniform float a; a = 1; a = noise(P); Ci = a; }
//! 1:39 error RSL_UNIFORM_FROM_VARYING declare it varying
