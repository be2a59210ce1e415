// functions of every type
float f_float(float a) { return a * 2; }
color f_color(color c) { return c * c; }
point f_point(point p) { return p + 1; }
vector f_vector(vector v) { return v ^ vector(1, 2, 3); }
normal f_normal(normal n) { return normalize(n); }
matrix f_matrix(float x) { return translate(1, vector(x, 0, 0)); }
string f_string(string a) { return concat(a, "!"); }
void f_void(output color c) { c += 0.125; }
surface function_typed() {
    Ci = f_color(Cs) * f_float(s) + color(f_vector(I)) * 0.01 + color(f_normal(N));
    Ci += color(transform(f_matrix(2), f_point(P))) * 0.1;
    if (f_string("a") == "a!") f_void(Ci);
}
