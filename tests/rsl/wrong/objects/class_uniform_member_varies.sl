class x() {
    uniform float a = 1;
    public void begin() { a = s; }
    public void surface(output color Ci, Oi) { Ci = a; }
}
//! 3:27 error RSL_UNIFORM_FROM_VARYING uniform 'a'
