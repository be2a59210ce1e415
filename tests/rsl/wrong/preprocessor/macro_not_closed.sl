#define SQR(x) ((x) * (x))
surface x() { Ci = SQR(s; }
//! 2:20 error RSL_MACRO_UNCLOSED macro 'SQR'
