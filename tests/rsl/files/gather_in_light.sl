light y() {
    gather("", Ps, Ns, 1, 4) { Cl = 1; }
}
//! 2:5 error RSL_STATEMENT_NOT_LEGAL gather cannot be used in light shaders
