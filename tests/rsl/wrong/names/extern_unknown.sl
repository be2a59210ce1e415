float f() { extern float gain; return gain; }
surface x(float gain = 1) { Ci = f(); }
//! 1:26 error RSL_EXTERN_UNKNOWN 'gain'
