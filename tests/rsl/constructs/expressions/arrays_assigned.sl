// whole arrays assigned and handed on
surface arrays_assigned(float k[3] = {1, 2, 3}) {
    float a[3] = {0.1, 0.2, 0.3}, b[3], c[3] = a;
    b = a;
    a[1] = s;
    float pass(float x[3]) { return x[0] + x[1] + x[2]; }
    Ci = pass(a) * color(1, 0, 0) + pass(b) * color(0, 1, 0) + pass(c) * color(0, 0, 1) + pass(k) * 0.1;
    b = k;
    Ci += b[2] * 0.01;
}
