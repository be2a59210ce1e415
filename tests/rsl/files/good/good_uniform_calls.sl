// A function that is uniform by itself stays so under the caller's varying control.
float twice(uniform float x) {
    uniform float y = x;
    y *= 2;
    if (y > 3) return y;
    return y + 1;
}
float first(float n) {
    float i = 0;
    while (i < n) {
        if (i > 2) break;
        i += 1;
    }
    return i;
}
surface x(uniform float k = 2;) {
    if (s > 0.5) {
        uniform float z = twice(k) + first(k);
        Ci = z;
    }
    Ci += s > 0.25 ? twice(first(k)) : 0;
}
