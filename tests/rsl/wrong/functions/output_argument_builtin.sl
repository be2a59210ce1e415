surface x() { float kr; fresnel(I, N, 1.5, kr, 0.5); Ci = kr; }
//! 1:48 error RSL_OUTPUT_ARGUMENT argument 5 of 'fresnel'
