void f() { return 1; }
surface x() { f(); Ci = 1; }
//! 1:12 error RSL_RETURN_VALUE void function 'f'
