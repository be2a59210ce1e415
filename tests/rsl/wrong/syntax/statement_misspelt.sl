surface x() {
    float i;
    fro (i = 0; i < 4; i += 1) Ci += 1;
    whlie (i > 0) i -= 1;
    illumnance(P, N, 1) { Ci += Cl; }
}
//! 3:5 error RSL_SYNTAX did you mean 'for'?
//! 4:5 error RSL_SYNTAX did you mean 'while'?
//! 5:5 error RSL_SYNTAX did you mean 'illuminance'?
