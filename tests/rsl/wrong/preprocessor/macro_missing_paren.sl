#define SQR(x) ((x) * (x)
surface x() {
    Ci = SQR(s);
}
//! 3:16 error RSL_SYNTAX expected ')'
