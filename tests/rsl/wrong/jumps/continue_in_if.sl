surface x() { if (s > 0.5) continue; Ci = 1; }
//! 1:28 error RSL_BREAK_OUTSIDE_LOOP 'continue' outside a loop
