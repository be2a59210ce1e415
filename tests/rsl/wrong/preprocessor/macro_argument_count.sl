#define LERP(a, b, t) ((a) + ((b) - (a)) * (t))
surface x() { Ci = LERP(Cs, Os); }
//! 2:20 error RSL_MACRO_ARGUMENTS macro 'LERP' takes 3 argument(s), 2 given
