class x() {
    float f(float a) { return a; }
    float f(float b) { return 2 * b; }
    public void surface(output color Ci, Oi) { Ci = f(1); }
}
//! 3:11 warning RSL_FUNCTION_REDEFINED 'f'
