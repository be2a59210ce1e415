// functions used before they are defined; a prototype
float second(float x);
float first(float x) { return second(x) + 1; }
float second(float x) { return x * 3; }
surface function_before_definition() { Ci = first(s) * 0.1; }
