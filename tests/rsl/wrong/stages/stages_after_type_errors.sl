light x() {
    Ci = 1;
    Cl = diffuse(N);
    float a = yy;
    uniform float u = noise(P);
}
//! 4:15 error RSL_UNKNOWN_VARIABLE unknown variable 'yy'
//! 2:5 warning RSL_GLOBAL_NOT_READABLE 'Ci' is not available in light shaders; here it is 0
//! 3:10 error RSL_NOT_LEGAL_HERE 'diffuse' cannot be used in light shaders
//! 5:23 error RSL_UNIFORM_FROM_VARYING declare it varying
