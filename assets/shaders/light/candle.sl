/* candle.sl: a small warm flame that flickers in brightness, colour and place.
   Parameters: intensity, flicker (0..1), speed (per second), size of its wandering, lightcolor. */
light candle(float intensity = 9; float flicker = 0.35; float speed = 5; float size = 0.12;
             color lightcolor = color(1, 0.62, 0.26);) {
    uniform float beat = speed * time;
    uniform float calm = 1 - flicker * (1.4 * float noise(beat) + 0.6 * float noise(2.7 * beat) - 0.7);
    uniform vector lean = vector(float noise(beat + 11) - 0.5, float noise(beat + 23) - 0.5,
                                 float noise(1.3 * beat + 37) - 0.5);
    vector jitter = vector random() - vector(0.5, 0.5, 0.5);
    illuminate(point "shader" (0, 0, 0) + size * (lean + jitter)) {
        /* A low flame is redder. */
        Cl = intensity * calm * lightcolor * mix(color(1, 0.8, 0.6), color(1, 1, 1), calm) /
             (0.2 + L . L);
    }
}
