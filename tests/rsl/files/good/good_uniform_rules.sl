float scale(float a; uniform float k) { return a * k; }
surface x(float k = 1; varying float w = 0;) {
    uniform float i, n = 0;
    for (i = 0; i < k; i += 1) n += i;
    float plain = 4;
    uniform float m = plain * n;
    if (s > 0.5) m = 2;       // each point has its own
    uniform float o = m;
    Ci = scale(s, o) + scale(k, 1) + w + time;
}
