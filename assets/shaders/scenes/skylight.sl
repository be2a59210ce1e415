/* skylight.sl: what comes from everywhere: cool light from above, warm light off the floor. */
light skylight(float intensity = 1; color above = color(0.17, 0.20, 0.25);
               color below = color(0.13, 0.085, 0.05);) {
    float up = zcomp(vtransform("world", normalize(vector N)));
    Cl = intensity * mix(below, above, smoothstep(-1, 1, up));
}
