class x() {
    constant float width = s;
    public void surface(output color Ci, Oi) { Ci = width; }
}
//! 2:28 error RSL_UNIFORM_FROM_VARYING varying value assigned to uniform 'width'
