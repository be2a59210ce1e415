// details on results and parameters of functions
uniform float twice(uniform float a) { return a * 2; }
varying float bend(varying float x; uniform float by) { return x * by; }
surface function_details(float k = 2) { Ci = bend(s, twice(k)); }
