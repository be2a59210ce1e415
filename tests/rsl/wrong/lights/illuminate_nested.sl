light x() { solar() { illuminate(P) { Cl = 1; } } }
//! 1:23 error RSL_NESTED_ILLUMINATE illuminate inside solar
