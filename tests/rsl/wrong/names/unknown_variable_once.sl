surface x() {
    float a = kd * 2;
    float b = kd * 3;
    Ci = a + b + kd;
}
//! 2:15 error RSL_UNKNOWN_VARIABLE 'kd'
