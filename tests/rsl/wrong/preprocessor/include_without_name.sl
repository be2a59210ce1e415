#include nosuch.h
surface x() { Ci = 1; }
//! 1:2 error RSL_BAD_DIRECTIVE #include needs
