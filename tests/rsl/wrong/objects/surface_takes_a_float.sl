class x() {
    public void surface(output float Ci; output color Oi) { Ci = 1; }
}
//! 2:17 error RSL_METHOD_PARAMETERS method 'surface' does not take what the renderer calls it with: (output color Ci; output color Oi)
