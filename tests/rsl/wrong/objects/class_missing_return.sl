class x() {
    float f(float a) { a + 1; }
    public void surface(output color Ci, Oi) { Ci = f(1); }
}
//! 2:24 warning RSL_NO_EFFECT
//! 2:11 warning RSL_MISSING_RETURN 'f'
