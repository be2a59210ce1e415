float scale = 2;
surface x() { Ci = 1; }
//! 1:7 error RSL_FILE_VARIABLE variable 'scale' stands outside
