surface x() { float i; for (i = 0; i < 3; i++) Ci = i; }
//! 1:44 warning RSL_INCREMENT taken as '+= 1'
