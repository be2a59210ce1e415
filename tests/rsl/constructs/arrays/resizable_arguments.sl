// resizable arrays as parameters: by value, read only, and output
float sum(float values[]) {
    float total = 0, k;
    for (k = 0; k < arraylength(values); k += 1) total += values[k];
    return total;
}
void fill(output point list[]; float n) {
    float k;
    resize(list, 0);
    for (k = 0; k < n; k += 1) push(list, point(k, n, s));
}
float twice(float values[]) {
    push(values, 100);
    values[0] = 2;
    return sum(values);
}
surface resizable_arguments(output varying float aov_sum = 0; output varying point aov_last = 0;) {
    float a[], fixed[3] = {1, 2, 3};
    point list[];
    push(a, s), push(a, t);
    fill(list, 3 + floor(t * 4));
    aov_sum = sum(a) + 10 * sum(fixed) + twice(a) + arraylength(a);
    aov_last = list[arraylength(list) - 1];
    float n = 4;
    float sized[n];
    sized[3] = s;
    Ci = aov_sum + sized[3] + arraylength(sized);
    Oi = 1;
}
