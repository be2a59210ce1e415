class x(float a = 1;) {
    public void surface(output color Ci, Oi) { Ci = directed(this); }
    color directed(float f) { return f; }
}
//! 2:53 error RSL_NO_OVERLOAD no form of 'directed' takes (shader)
