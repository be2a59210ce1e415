float late(float a) { return early(a) + 1; }
early(float a) { return a * 2; }
void split(color c; output float r, g; output varying float b) {
    r = comp(c, 0); g = comp(c, 1); b = comp(c, 2);
}
float sum(float a[]) {
    float i, total = 0;
    for (i = 0; i < 3; i += 1) total += a[i];
    return total;
}
float sign2(float x) {
    if (x < 0) return -1;
    if (x > 0) return 1;
    return 0;
}
surface x(float k[3] = {1, 2, 3};) {
    float r, g, b;
    float scaled(float a) { extern float r; return a * r; }
    split(Cs, r, g, b);
    Ci = color(r, g, b) * late(1) * sum(k) * scaled(sign2(s - 0.5));
}
