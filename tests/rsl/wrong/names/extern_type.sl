float f() { extern float P; return 1; }
surface x() { Ci = f(); }
//! 1:26 error RSL_TYPE_MISMATCH extern 'P'
