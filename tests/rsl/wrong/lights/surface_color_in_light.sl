light x() { solar() { Ci = 1; Cl = 1; } }
//! 1:23 warning RSL_GLOBAL_NOT_READABLE 'Ci' is not available in light shaders
