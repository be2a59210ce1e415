// sums over array parameters
surface arrays_in_uniform_loop(uniform float freq[3] = {1, 2, 4}; uniform float amp[3] = {0.5, 0.25, 0.125}) {
    uniform float i;
    float sum = 0;
    for (i = 0; i < 3; i += 1) sum += amp[i] * float noise(P * freq[i]);
    Ci = sum * Cs;
}
