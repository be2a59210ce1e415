// resizable arrays: resize, push, pop, arraylength, capacity, reserve, copies
surface resizable_basics(float n = 3; output varying float aov_len = 0; output varying color aov_sum = 0;) {
    float a[];
    color c[];
    string names[];
    reserve(a, 20);
    resize(a, n);
    a[0] = s;
    a[1] = t;
    push(a, s * t);
    push(a, 2);
    float last = pop(a);
    push(names, "one");
    push(names, concat("two", "x"));
    uniform float k;
    for (k = 0; k < arraylength(a); k += 1) {
        push(c, color(a[k], k, s));
    }
    color d[] = {1, (0, 1, 0)};
    push(d, Cs);
    d[1] = d[0] * 0.5;
    color copy[];
    copy = d;
    push(copy, 3);
    float fixed[4] = {1, 2, 3, 4};
    float from_fixed[];
    from_fixed = fixed;
    push(from_fixed, s);
    fixed = from_fixed;
    aov_len = arraylength(copy) * 10 + arraylength(d) + arraylength(fixed) + capacity(a) * 0.01 + strlen(names[1]);
    aov_sum = c[0] + c[1] * c[3] + copy[3] * last + copy[2] + from_fixed[4] + fixed[3];
    Ci = aov_sum * aov_len;
    Oi = Os;
}
