#inclde "a.h"
surface x() { Ci = 1; }
//! 1:2 error RSL_UNKNOWN_DIRECTIVE did you mean '#include'?
