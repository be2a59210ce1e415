class x(shader base = null;) {
    public void surface(output color Ci, Oi) { Ci = 1; }
}
//! 1:9 error RSL_2 'shader'
