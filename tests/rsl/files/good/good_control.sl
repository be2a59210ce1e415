surface x(float count = 4;) {
    float i, j, sum = 0;
    for (i = 0, j = 1; i < count; i += 1, j += 1) {
        if (i == 2) continue;
        while (sum < 10) {
            sum += j;
            if (sum > 5) break 2; else continue 2;
        }
    }
    if (sum) ; else sum = 1;
    for (;;) break;
    Ci = sum > 1 ? Cs : 1;
}
