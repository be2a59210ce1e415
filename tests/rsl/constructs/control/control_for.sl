// for with several initialisers and steps, declarations, and empty parts
surface control_for() {
    float i, j, sum = 0;
    for (i = 0, j = 8; i < j; i += 1, j -= 1) sum += i * j;
    for (float k = 0; k < 3; k += 1) sum += k;
    for (uniform float m = 4; m > 0; m -= 1) { sum -= 0.1; }
    i = 0;
    for (; i < 3;) i += 1;
    for (i = 0; ; i += 1) { if (i > 5) break; sum += 0.01; }
    Ci = sum * 0.01 * s;
}
