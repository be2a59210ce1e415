/* bulblight.sl: what a glowing bulb gives its room. It is a ball of light, so the fine wire in its
   middle leaves no sharp shadow. */
light bulblight(float glow = 1; float intensity = 0.9; float radius = 0.3;
                color lightcolor = color(1, 0.72, 0.40);) {
    vector jitter = vector(float random(), float random(), float random()) - vector(0.5, 0.5, 0.5);
    illuminate(point "shader" (0, 0, 0) + 2 * radius * jitter) {
        Cl = glow * intensity * lightcolor / (0.3 + L . L);
    }
}
