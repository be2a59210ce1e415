// while loops
surface control_while() {
    float n = 0, x = s;
    while (x < 4) { x *= 2; n += 1; }
    while (n > 3) n -= 1;
    Ci = n * 0.1 * t;
}
