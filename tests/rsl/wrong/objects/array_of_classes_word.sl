class x(float a = 1;) {
    public void surface(output color Ci, Oi) { Ci = a->b; }
}
//! 2:53 error RSL_NOT_STRUCT '->' needs a struct, and 'a' is none
