surface x() { Ci = 1; }
#endif
//! 2:2 error RSL_STRAY_DIRECTIVE #endif without its #if
