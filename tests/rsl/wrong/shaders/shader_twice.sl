surface x() { Ci = 1; }
surface x() { Ci = 0; }
//! 2:9 error RSL_SHADER_REDEFINED shader 'x'
