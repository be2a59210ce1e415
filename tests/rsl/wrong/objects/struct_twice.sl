struct A { float k; }
struct A { float j; }
surface x() {
    A a;
    Ci = a->k;
}
//! 2:8 error RSL_REDEFINED 'A'
