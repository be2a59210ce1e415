class x(float a = 1;) {
    float kept = 0;
    public void surface(output color Ci, Oi) { Ci = a * kpet; }
}
//! 3:57 error RSL_UNKNOWN_VARIABLE unknown variable 'kpet'
