// resizable arrays of more than 64 elements: lengths from parameters and from the point
float total(float values[]) {
    float sum = 0, k;
    for (k = 0; k < arraylength(values); k += 1) sum += values[k];
    return sum;
}
float doubled(float values[]) {
    float k, n = arraylength(values);
    for (k = 0; k < n; k += 1) push(values, 1);
    return total(values);
}
surface resizable_long(float count = 200; output varying float aov_len = 0; output varying float aov_sum = 0;) {
    float a[], b[];
    color c[];
    uniform float k;
    for (k = 0; k < count; k += 1) push(a, k);
    resize(b, 70 + floor(s * 100));
    b[arraylength(b) - 1] = t;
    float turn;
    for (turn = 0; turn < 60 + floor(t * 30); turn += 1) push(c, color(turn, s, 1));
    b = a;
    aov_len = arraylength(a) + 1000 * arraylength(c) + (a == b);
    b[150] = -1;
    aov_sum = total(a) + doubled(a) + doubled(b) + (a == b) + a[199] + comp(c[59], 0);
    while (arraylength(c) > 3) pop(c);
    Ci = c[2] + aov_sum * 0.001;
    Oi = 1;
}
