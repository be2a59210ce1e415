surface filament(float freq = 5.0, phase = 0.0, width = 0.3; color filcolor = color (1, .84, .76);) {
    float distance; /* Distance from the spiral */
    distance = mod((t * freq + s + phase), 1.0);
    if (distance < width) {
        Ci = filcolor;
        Oi = 1.0;
    } else {
        Oi = 0.0;
    }
}
