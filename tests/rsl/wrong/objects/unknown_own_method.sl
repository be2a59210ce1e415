class x() {
    float pattern(float a) { return mod(a, 1); }
    public void surface(output color Ci, Oi) { Ci = this->patern(s); }
}
//! 3:53 error RSL_UNKNOWN_FUNCTION unknown function 'patern'
