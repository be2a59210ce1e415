surface x() {
    struct A { float k; }
    A a;
    Ci = a->j;
}
//! 4:10 error RSL_NO_MEMBER struct 'A' has no member 'j'
