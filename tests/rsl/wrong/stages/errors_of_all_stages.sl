surface x(float a = 1 float b = 2) {
    color c = Cs
    bool d = e;
    float f = N;
    Ci = c * a * b * d * f;
}
//! 1:22 error RSL_SYNTAX expected ';'
//! 2:17 error RSL_SYNTAX expected ';'
//! 3:5 error RSL_UNKNOWN_TYPE write 'float'
//! 3:14 error RSL_UNKNOWN_VARIABLE 'e'
//! 4:15 error RSL_TYPE_MISMATCH this is normal
