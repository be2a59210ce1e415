surface (float a = 1) { Ci = a; }
//! 1:9 error RSL_SYNTAX a shader name
