surface x() { uniform float a = s; Ci = a; }
//! 1:33 error RSL_UNIFORM_FROM_VARYING uniform 'a'
