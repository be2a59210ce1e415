class x() {
    public void opacity(output color Ci; output color Oi) { Ci = 1; Oi = 1; }
    public void surface(output color Ci, Oi) { Ci = 1; }
}
//! 2:17 error RSL_METHOD_PARAMETERS method 'opacity' does not take what the renderer calls it with: (output color Oi)
