surface x(float roughness = 0.1) {
    Ci = specular(N, -I, roughnes);
}
//! 2:26 error RSL_UNKNOWN_VARIABLE did you mean 'roughness'?
