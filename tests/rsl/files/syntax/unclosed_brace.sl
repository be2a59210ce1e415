surface x() {
    if (s > 0.5) {
        Ci = 1;
