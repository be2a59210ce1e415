struct A { float k; }
surface x() {
    A a, b;
    a += b;
    Ci = a->k;
}
//! 4:10 error RSL_STRUCT_VALUE this needs a struct of type 'A'
