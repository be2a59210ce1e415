// calls in calls
float f(float x) { return x * x; }
float g(float x, y) { return f(x) + f(y); }
color h(color c; float k) { return mix(c, color(g(k, 1)), f(g(k, k))); }
surface function_of_functions() { Ci = h(h(Cs, s * 0.3), f(f(t)) * 0.3); }
