/* halo.sl: the glow around a filament: a sphere of light that is densest in its middle. */
surface halo(float glow = 1; color halocolor = color(1, 0.68, 0.30);) {
    normal Nf = faceforward(normalize(N), I);
    float middle = clamp(-(Nf . normalize(I)), 0, 1);
    float strength = pow(middle, 3);
    /* The far side is seen through the near one: each gives a half. */
    Oi = 0.22 * strength;
    Ci = 0.5 * glow * strength * halocolor;
}
