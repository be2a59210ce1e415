void f() { }
surface x() { Ci = f(); }
//! 2:20 error RSL_VOID_VALUE 'f' returns nothing
