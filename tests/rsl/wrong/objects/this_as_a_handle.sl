class x(float a = 1;) {
    public void surface(output color Ci, Oi) { Ci = directed(this); }
    color directed(float f) { return f; }
}
//! 2:62 error RSL_2 'this' as a shader's handle
