surface kr(float Ka;) float Kd;
{ Ci = Ka; Oi = nosuch; }
//! 1:22 error RSL_SYNTAX expected '{' before 'float'
//! 2:17 error RSL_UNKNOWN_VARIABLE unknown variable 'nosuch'
