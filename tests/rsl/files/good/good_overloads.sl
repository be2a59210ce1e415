float area2(float a) { return a; }
float area2(point p) { return length(p); }
color abs(color c) { return c; }  // shadows the built-in
surface x() { Ci = area2(s) + area2(P) + abs(Cs); }
