// arguments left out: the parameters' defaults
float wave(float x; float frequency = 2; float offset = frequency_of(3)) {
    return sin(x * frequency + offset);
}
float frequency_of(float k) { return k * 0.5; }
surface function_defaults() {
    Ci = color(wave(s), wave(t, 3), wave(s, 1, 2));
    Oi = 1;
}
