surface x() {
    struct A { float k; }
    A a;
    Ci = a->k;
}
//! 2:5 error RSL_2 a struct inside a function
