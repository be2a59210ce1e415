surface x() { Ci = 1; }
/* the rest
