surface x() { Ci = filterwidth(s); }
//! 1:20 error RSL_UNKNOWN_FUNCTION #include "filterwidth.h"
