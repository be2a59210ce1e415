class glass(float a = 1;) {
    public void surface(output color Ci, Oi) { Ci = a; }
}
surface x() { Ci = 1; }
//! 1:1 error RSL_NOT_RSL 'class' (RSL 2.0) is not part of the shading language 3.2
