surface x() { Ci = 1; break; }
//! 1:23 error RSL_BREAK_OUTSIDE_LOOP 'break' outside a loop
