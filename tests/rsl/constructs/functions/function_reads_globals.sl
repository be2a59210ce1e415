// functions read and write globals without extern
void finish() { Oi = Os; Ci *= Oi; }
color lookup() { return color(s, t, u + v); }
surface function_reads_globals() { Ci = lookup(); finish(); }
