/* filament.sl: a spiral of hot wire on a plain cylinder: opaque near the spiral, else not there. */
surface filament(float freq = 5; float phase = 0; float width = 0.3; float glow = 1;
                 color filcolor = color(1, 0.84, 0.62);) {
    float distance = mod(t * freq + s + phase, 1);
    float inside = 0;
    if (distance < width)
        inside = 1;
    Oi = inside;
    Ci = Oi * glow * 2.2 * filcolor;
}
