class x() {
    float a = 1;
    color a = 1;
    public void surface(output color Ci, Oi) { Ci = a; }
}
//! 3:11 warning RSL_REDECLARED 'a'
