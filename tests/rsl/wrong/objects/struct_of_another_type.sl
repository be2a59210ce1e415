struct A { color tint; }
struct B { color tint; }
surface x() {
    A a;
    B b;
    a = b;
    Ci = a->tint;
}
//! 6:9 error RSL_STRUCT_VALUE this needs a struct of type 'A'
