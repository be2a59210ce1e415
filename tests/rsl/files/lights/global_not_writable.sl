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
//! 2:5 warning RSL_GLOBAL_NOT_WRITABLE 'E' cannot be assigned in surface shaders
//! 3:5 warning RSL_GLOBAL_NOT_WRITABLE 'Ng' cannot be assigned in surface shaders
