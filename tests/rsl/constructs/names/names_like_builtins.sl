// variables with the names of built-in functions
surface names_like_builtins(float noise = 2, mix = 0.5; string texture = "") {
    color diffuse = diffuse(faceforward(normalize(N), I));
    color ambient = ambient();
    float length = length(I), step = step(0.5, s), area = 1, depth = 0.1;
    Ci = diffuse * noise(P * noise) + ambient * mix + mix(Cs, Os, mix) * step * area + length * depth;
}
