float pick(uniform float x) {
    if (u > 0.5) return 1;
    return x;
}
float last(uniform float n) {
    float i = 0;
    while (i < n) {
        if (v > 0.5) break;
        i += 1;
    }
    return i;
}
surface x(float k = 1;) {
    float kept = 0;
    void keep(uniform float x) { extern float kept; kept = x; }
    if (s > 0.5) keep(k);
    uniform float a = pick(k);
    uniform float b = last(k);
    uniform float c = kept;
    Ci = a + b + c;
}
//! 17:23 error RSL_UNIFORM_FROM_VARYING varying value assigned to uniform 'a'
//! 18:23 error RSL_UNIFORM_FROM_VARYING varying value assigned to uniform 'b'
//! 19:23 error RSL_UNIFORM_FROM_VARYING varying value assigned to uniform 'c'
