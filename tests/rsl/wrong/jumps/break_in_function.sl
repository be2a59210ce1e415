void f() { break; }
surface x() { while (s > 2) f(); Ci = 1; }
//! 1:12 error RSL_BREAK_OUTSIDE_LOOP 'break' outside a loop
