surface x() { while (s > 2) { break 2; } Ci = 1; }
//! 1:31 error RSL_BREAK_LEVELS only 1 loop(s)
