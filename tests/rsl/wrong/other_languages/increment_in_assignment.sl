surface x() { float a = 1; a = a++; Ci = a; }
//! 1:33 error RSL_NOT_RSL write 'i += 1'
