class x(float a = 1;) {
    float kept = 0;
    kept = 2;
    public void surface(output color Ci, Oi) { Ci = a * kept; }
}
//! 3:5 error RSL_SYNTAX expected a member or method
