// resizable arrays whose length differs between points
surface resizable_per_point(output varying float aov_len = 0; output varying float aov_sum = 0;) {
    float a[];
    float k;
    float turns = floor(s * 9);
    for (k = 0; k < turns; k += 1) {
        push(a, k * t);
        if (mod(k, 3) == 2) aov_sum += pop(a);
    }
    if (t > 0.5) {
        resize(a, 3);
        a[2] = 7;
    } else if (s > 0.3) {
        float b[] = {1, 2, 3};
        a = b;
        push(a, s);
    }
    aov_len = arraylength(a);
    for (k = 0; k < arraylength(a); k += 1) {
        aov_sum += a[k] * (k + 1);
        if (k > 4) break;
    }
    Ci = color(aov_len, aov_sum, s);
    Oi = 1;
}
