displacement y() {
    gather("", P, N, 1, 4) { P += N; }
}
//! 2:5 error RSL_STATEMENT_NOT_LEGAL gather cannot be used in displacement shaders
