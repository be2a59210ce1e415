class x(shader base = "base";) {
    public void surface(output color Ci, Oi) { Ci = 1; }
}
//! 1:23 error RSL_HANDLE_WANTED this is no shader
