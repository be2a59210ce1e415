float[3] f() { float a[3]; return a; }
surface x() { Ci = 1; }
//! 1:1 error RSL_NOT_RSL output parameter
