surface x() {
    if (s > 0.5) { if (t > 0.5) Ci = 1; } else Ci = 2;
    if (s > 0.5) if (t > 0.5) Ci = 1; else Ci = 2;
    Oi = - - s;
    Oi = -(-s - -t) - (s - (t - u)) / (v / (s / t));
    Ci = s > t ? u > v ? 1 : 2 : (s == 0 ? 3 : 4);
}
