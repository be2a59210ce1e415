float f(float a = f()) { return a; }
surface s() { Ci = f(); }
//! 1:19 error RSL_TOO_DEEP nested too deeply: at most 4 defaults
