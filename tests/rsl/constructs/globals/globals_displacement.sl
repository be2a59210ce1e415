// displacements read and write P and N, and Ci
displacement globals_displacement(float Km = 0.1) {
    float amount = Km * float noise(P * 4) * s * t * u * v;
    P += amount * normalize(N);
    N = calculatenormal(P);
    Ci = color(1, 0, 0);
    Oi = Cs * Os;
}
