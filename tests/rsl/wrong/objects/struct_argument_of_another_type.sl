struct A { float k; }
struct B { float k; }
float f(A a) { return a->k; }
surface x() {
    B b;
    Ci = f(b);
}
//! 6:10 error RSL_NO_OVERLOAD no form of 'f' takes (struct B)
