struct S { float x = 1; float y = 2; void f() { y = 2; } }
class x(float unused = 1;) {
    public float seen_by_others = 2;
    public color tint(color c) { return c; }
    public void surface(output color Ci, Oi) {
        S a;
        float lost = 1;
        float sized[s * 3 + 1];
        a->f();
        Ci = a->x + sized[0];
    }
}
//! 2:15 warning RSL_UNUSED_PARAMETER 'unused'
//! 7:15 warning RSL_UNUSED_VARIABLE 'lost'
