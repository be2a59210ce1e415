#ifdef A
surface y() { Ci = 1; }
//! 1:2 error RSL_UNTERMINATED_IF without its #endif
