surface x(float eta = 1.5;) {
    float kr, kt;
    vector R, T;
    point Q;
    fresnel(normalize(I), N, eta, kr, kt, R, T);
    fresnel(I, N, eta, kr, kt, Q, T);
    Ci = kr * trace(P, R) + kt * trace(P, T) + refract(I, N, eta);
    float distance = trace(P, R);
    Oi = distance;
}
