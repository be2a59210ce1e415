light a(float i = 1) { Cl = i; L = 0; }
light b(float i = 1) { L = vector(0, 0, 0); Cl = i; }
light c(float i = 1) { L = (0, 0, 0); Cl = i; }
light d(float i = 1) { L = (0, 0, 1); Cl = i; }
//! 4:24 warning RSL_ONLY_IN_ILLUMINATE 'L' is only known
