// overloads by argument and by result type
float size(float a) { return abs(a); }
float size(vector a) { return length(a); }
color size(color a) { return a * 2; }
surface function_overloads() { Ci = size(Cs) * size(s) + size(vector N) * 0.1; }
