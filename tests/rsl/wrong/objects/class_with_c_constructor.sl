class x(float n = 1;) {
    float m;
    x() { m = n; }
    public void surface(output color Ci, Oi) { Ci = m; }
}
//! 3:5 warning RSL_CLASS_NAME_METHOD method 'x' has the name of its class, and nothing calls it
