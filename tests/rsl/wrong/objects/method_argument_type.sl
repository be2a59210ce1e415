struct A { float k; void init(float x) { k = x; } }
surface x() {
    A a;
    a->init("one");
    Ci = a->k;
}
//! 4:13 error RSL_TYPE_MISMATCH argument 2 of 'A->init' needs float, this is string
