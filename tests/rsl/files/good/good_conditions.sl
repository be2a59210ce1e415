surface x(float on = 1;) {
    float a = on == 1, b = !a, c = (s > 0.2) + (t > 0.2);
    if (a) Ci = b;
    if (N == I || P != E) Ci = c * (u < v);
    while (!on) { Ci = 1; break; }
    Oi = on ? s > 0.5 : 0;
}
