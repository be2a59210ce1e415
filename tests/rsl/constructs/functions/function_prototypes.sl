// prototypes with ';' between parameters; inline, static and export before functions
float f(float a; color b);
export color g(point p; uniform float k;);
inline float twice(float x) { return 2 * x; }
surface function_prototypes() { Ci = f(s, Cs) * g(P, 2); }
static float f(float a; color b) { return twice(a) * comp(b, 0); }
color g(point p; uniform float k;) { return color noise(p * k); }
