class x() {
    public void surface(output color Ci, Oi) { float a = getshader("base"); Ci = a; }
}
//! 2:58 error RSL_2 'getshader()' belongs to the part of RSL 2.0
