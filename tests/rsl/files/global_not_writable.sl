surface x() {
    E = P;
    Ng = N;
    P = P + N;
    N = calculatenormal(P);
    I = -I;
    s = t; u = v;
    Ci = Cs;
}
displacement y() { Ci = 1; P += N; }
//! 2:5 error RSL_GLOBAL_NOT_WRITABLE 'E' cannot be assigned in surface shaders
//! 3:5 error RSL_GLOBAL_NOT_WRITABLE 'Ng' cannot be assigned in surface shaders
//! 10:20 error RSL_GLOBAL_NOT_READABLE 'Ci' is not available in displacement shaders
