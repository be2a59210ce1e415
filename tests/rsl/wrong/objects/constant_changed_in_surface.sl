class x(float n = 4;) {
    constant float width = 1 / n;
    public void surface(output color Ci, Oi) {
        width = 2;
        Ci = width;
    }
}
//! 4:9 warning RSL_CONSTANT_CHANGED constant 'width' is changed outside of construct()
