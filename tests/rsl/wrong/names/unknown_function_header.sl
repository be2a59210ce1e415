surface x() { Ci = snoise(P); }
//! 1:20 error RSL_UNKNOWN_FUNCTION #include "noises.h"
