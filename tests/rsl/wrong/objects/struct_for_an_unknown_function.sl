struct A { float k; }
surface x() {
    A a;
    Ci = nosuch(a);
}
//! 4:10 error RSL_UNKNOWN_FUNCTION unknown function 'nosuch'
