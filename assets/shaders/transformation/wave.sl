/* wave.sl: a thing seen through moving water: sideways waves that run up.
   Parameters: amplitude, wavelength, speed in waves per second. */
transformation wave(float amplitude = 0.10; float wavelength = 0.9; float speed = 1;) {
    float phase = 2 * PI * (zcomp(P) / wavelength - speed * time);
    P += amplitude * vector(sin(phase), 0.6 * cos(0.7 * phase), 0);
}
