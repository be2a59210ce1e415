float f(float a) { return a < 0 ? 0 : g(a - 1); }
float g(float a) { return f(a); }
float fact(uniform float n) { if (n <= 1) return 1; return n * fact(n - 1); }
float varying_depth(varying float n) { float x = n; if (n > 0) x += varying_depth(n - 1); return x; }
void fill(output float a[]; float k) { if (k < 0) return; a[k] = k; fill(a, k - 1); }
surface x()
{
    uniform float u = fact(5);
    float a[4];
    fill(a, 3);
    color tree(float depth; point p) {
        if (depth <= 0) return color noise(p);
        return 0.5 * (tree(depth - 1, p * 2) + tree(depth - 1, p + 1));
    }
    Ci = f(1) + u + varying_depth(s) + a[2] + tree(3, P);
}
