// locals that hide globals, parameters and outer locals; redeclared in the same block
surface names_hiding(float Ka = 1; varying point Pref = (1, 2, 3)) {
    float Ka = 0.5;
    vector L = vector(0, 0, 1);
    float s = 2;
    { float s = 3; Ka += s; { color Ka = 0.1; Ci = Ka; } }
    float i = 1;
    float i = 2;
    Ci += Ka * s * 0.1 + (L . N) * 0.01 + i + length(Pref) * 0.1;
}
