surface x() { Ci = nosuch(1); }
//! 1:20 error RSL_UNKNOWN_FUNCTION unknown function 'nosuch'
