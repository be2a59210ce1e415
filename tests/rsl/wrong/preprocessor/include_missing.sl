#include "nosuch.h"
surface x() { Ci = 1; }
//! 1:10 error RSL_INCLUDE_NOT_FOUND 'nosuch.h' not found
