// if, else, chains, and single statements
surface control_if() {
    if (s > 0.5) Ci = Cs;
    else if (t > 0.5) { Ci = Cs * 0.5; }
    else Ci = 0.1;
    if (s < 0.25 && t < 0.75 || !(s == t)) if (t > 0.1) Ci += 0.1; else Ci += 0.2;
    if (Ci != color(0, 0, 0)) ; else { }
}
