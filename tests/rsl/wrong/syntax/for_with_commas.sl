surface x() {
    float i;
    for (i = 0, i < 3, i += 1) Ci = i;
}
//! 3:30 error RSL_SYNTAX expected ';'
