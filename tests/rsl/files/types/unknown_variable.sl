surface x(float roughness = 0.1;) {
    float a = roughnes * 2;
    float b = roughnes * 3;  // said once
    Ci = a + b;
}
//! 2:15 error RSL_UNKNOWN_VARIABLE did you mean 'roughness'?
