// output parameters, and value parameters that are assigned
void split(color c; output float r, g, b) { r = comp(c, 0); g = comp(c, 1); b = comp(c, 2); }
float drop(float x) { x = x * 0.5; return x; }
void both(output point p; output uniform float n) { p = p + 1; n += 1; }
surface function_output() {
    float a, b, c, k = s;
    uniform float n = 1;
    point q = P;
    split(Cs, a, b, c);
    both(q, n);
    Ci = color(a, b, c) * drop(k) + k + color q * 0.01 * n;
    split(Cs, Ci[0], a, Ci[2]);
}
