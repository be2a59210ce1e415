/* fbm_ramp.sl: eight octaves of noise through a color ramp of eight knots, no light. */
surface fbm_ramp(float frequency = 1.5; float gain = 0.5; float lacunarity = 2;) {
    point at = frequency * transform("object", P);
    float sum = 0, weight = gain, octave;
    for (octave = 0; octave < 8; octave += 1) {
        sum += weight * (2 * noise(at) - 1);
        weight *= gain;
        at *= lacunarity;
    }
    Oi = Os;
    Ci = Os * Cs * spline(0.5 + 0.8 * sum, color(0.01, 0.02, 0.06), color(0.02, 0.05, 0.16),
                          color(0.08, 0.20, 0.38), color(0.30, 0.47, 0.52), color(0.72, 0.66, 0.48),
                          color(0.87, 0.79, 0.62), color(0.95, 0.93, 0.88), color(1, 1, 1));
}
