// local arrays, indexed by constants, counters and points, with initial values
surface arrays_local() {
    float a[4], b[3] = {1, 2, 3}, c[] = {s, t, s * t};
    color ramp[4] = {color(0, 0, 0), color(1, 0, 0), (1, 1, 0), 1};
    point q[2];
    uniform float i;
    for (i = 0; i < 4; i += 1) a[i] = i * s;
    q[0] = P; q[1] = q[0] + a[2];
    Ci = ramp[floor(s * 3.99)] * (b[0] + b[1] + c[2]) * 0.1 + a[floor(t * 3.99)] + color(q[1]) * 0.01;
}
