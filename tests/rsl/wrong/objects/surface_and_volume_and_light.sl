class x() {
    public void surface(output color Ci, Oi) { Ci = 1; }
    public void light(output vector L; output color Cl) { L = 1; Cl = 1; }
}
//! 2:17 warning RSL_METHOD_NOT_CALLED method 'surface' is not called: class 'x' is a light
