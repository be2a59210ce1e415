surface x(float Kd = 1) {
    Ci = Kd Cs;
}
//! 2:13 error RSL_SYNTAX expected ';'
