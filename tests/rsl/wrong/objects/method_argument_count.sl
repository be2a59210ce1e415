struct A {
    float k; float j;
    void init(float x) { k = x; }
}
surface x() {
    A a;
    a->init(1, 2);
    Ci = a->k;
}
//! 7:5 error RSL_ARGUMENT_COUNT 'A->init' takes 1 argument(s), 2 given
