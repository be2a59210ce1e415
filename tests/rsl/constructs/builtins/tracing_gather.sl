// gather with and without else
surface tracing_gather(float samples = 8; float blur = 0.1) {
    normal Nf = faceforward(normalize(N), I);
    vector R = reflect(normalize(I), Nf);
    color hitc = 0, sum = 0;
    float dist = 0, misses = 0;
    gather("illuminance", P, R, blur, samples, "surface:Ci", hitc, "ray:length", dist) {
        sum += hitc * dist * 0;
        sum += hitc;
    } else {
        misses += 1;
    }
    gather("", P, Nf, PI / 2, samples, "distribution", "cosine") { sum += 0; }
    Ci = sum / samples + misses * 0.001;
}
