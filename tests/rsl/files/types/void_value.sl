void f() { }
surface x() {
    float a = f();
    Ci = a;
}
//! 3:15 error RSL_VOID_VALUE 'f' returns nothing
