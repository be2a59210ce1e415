class x(float a = 1;) {
    float kept = 0;
    public void surface(output color Ci, Oi) { Ci = a; }
//! 1:23 error RSL_UNCLOSED '{'
