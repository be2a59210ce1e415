// ++ and -- of other languages, taken as += 1 and -= 1
surface control_increment() {
    float i, n = 0;
    for (i = 0; i < 4; i++) n += i;
    for (i = 4; i > 0; --i) n++;
    ++n;
    n--;
    Ci = n * 0.05 * Cs;
}
