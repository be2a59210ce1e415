// break 2 and continue 2
surface control_break_levels() {
    float i, j, n = 0;
    for (i = 0; i < 5; i += 1) {
        for (j = 0; j < 5; j += 1) {
            if (j > s * 5) continue 2;
            if (i * j > t * 10) break 2;
            n += 1;
        }
        n += 10;
    }
    Ci = n * 0.01;
}
