surface (float a) { Ci = 1; }
sruface y() { Ci = 1; }
float float f() { return 1; }
surface z() { Ci = 1; }
//! 1:9 error RSL_SYNTAX expected a shader name before '('
//! 2:1 error RSL_SYNTAX did you mean 'surface'?
//! 3:1 error RSL_SYNTAX expected a shader or function definition before 'float'
