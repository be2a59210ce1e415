struct T { float z = 1; }
struct S { T t; }
class x() {
    S m;
    public void surface(output color Ci, Oi) {
        T other = m->u;
        other = m->v;
        Ci = m->w->z;
    }
}
//! 6:19 error RSL_NO_MEMBER struct 'S' has no member 'u'
//! 7:17 error RSL_NO_MEMBER struct 'S' has no member 'v'
//! 8:14 error RSL_NO_MEMBER struct 'S' has no member 'w'
