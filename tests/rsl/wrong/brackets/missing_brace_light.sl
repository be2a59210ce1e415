light x(float intensity = 1; color lightcolor = 1) Cl = intensity * lightcolor * unknown;
//! 1:51 error RSL_SYNTAX expected '{' before 'Cl'
//! 1:82 error RSL_UNKNOWN_VARIABLE unknown variable 'unknown'
