light x() {
    illuminate(P) { solar() { Cl = 1; } }
}
//! 2:21 error RSL_NESTED_ILLUMINATE solar inside illuminate
