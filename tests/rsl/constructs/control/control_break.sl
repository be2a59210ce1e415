// break and continue that depend on the point
surface control_break() {
    float i, sum = 0;
    for (i = 0; i < 10; i += 1) {
        if (mod(i, 2) == 1) continue;
        if (i > s * 10) break;
        sum += i;
    }
    i = 0;
    while (1) { i += 1; if (i > t * 5) break; if (i < 2) continue; sum += 1; }
    Ci = sum * 0.05;
}
