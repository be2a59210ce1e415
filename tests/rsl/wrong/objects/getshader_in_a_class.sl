class x() {
    public void surface(output color Ci, Oi) { float a = getshader("base"); Ci = a; }
}
//! 2:58 error RSL_HANDLE_AS_VALUE a shader is no value that this can use
