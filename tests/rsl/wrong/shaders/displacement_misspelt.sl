displacment x() { P += N; }
//! 1:1 error RSL_SYNTAX did you mean 'displacement'?
