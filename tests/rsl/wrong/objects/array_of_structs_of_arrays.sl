struct A { float list[]; }
surface x() {
    A a[2];
    Ci = 1;
}
//! 3:7 error RSL_STRUCT_ARRAYS struct 'A' has an array of changing length among its members
