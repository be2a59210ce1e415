class x() {
    float width(float a);
    public void surface(output color Ci, Oi) { Ci = width(1); }
}
//! 2:25 error RSL_SYNTAX expected the method's body, '{ ... }', before ';'
