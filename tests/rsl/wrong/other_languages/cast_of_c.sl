surface x() {
    float a = (int) (s * 4);
    Ci = a + int(t * 4) + (double) s;
}
//! 2:16 error RSL_UNKNOWN_TYPE use floor(x)
//! 3:28 error RSL_UNKNOWN_TYPE write 'float'
//! 3:14 error RSL_UNKNOWN_FUNCTION use floor(x)
