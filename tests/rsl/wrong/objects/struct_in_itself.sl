struct A { color tint; A other; }
surface x() {
    A a;
    Ci = a->tint;
}
//! 1:26 error RSL_STRUCT_IN_ITSELF member 'other' of struct 'A'
