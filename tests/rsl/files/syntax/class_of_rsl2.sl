class glass(float a = 1;) {
    public void surface(output color Ci, Oi) { Ci = a; }
}
surface x() { Ci = 1; }
//! 1:1 error RSL_2 'class' (shader objects) belongs to RSL 2.0
