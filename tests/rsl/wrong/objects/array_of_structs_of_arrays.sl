struct A { float list[3]; }
surface x() {
    A a[2];
    Ci = 1;
}
//! 3:7 error RSL_STRUCT_ARRAYS struct 'A' has an array among its members
