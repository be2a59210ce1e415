#define fade(x) ((x) * 0.5)
#define half 0.5
float fade(float x) { return x; }
float half(float x) { return x / 2; }
surface x() { Ci = fade(s) + nosuch; }
//! 3:7 error RSL_SYNTAX the function's name is a macro: '#undef fade'
//! 4:7 error RSL_SYNTAX the function's name is a macro: '#undef half'
//! 5:30 error RSL_UNKNOWN_VARIABLE unknown variable 'nosuch'
