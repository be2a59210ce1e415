surface x() {
    color a = pow(Cs, 2) + mod(Cs, 0.5) + abs(Cs - 1) + smoothstep(0, 1, Cs) + min(Cs, 1, Os);
    color b = max(Cs, (0.1, 0.2, 0.3)) + clamp(Cs, 0, 1) + mix(Cs, Os, Cs);
    point q = P + N * I / (P - I);
    color c = P;
    if (Cs == Os) c = normalize(c);
    Ci = a + b * c + q;
}
