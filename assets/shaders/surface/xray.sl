/* xray.sl: an X-ray picture, or a hologram: glows where the surface turns away, clear where one
   looks straight through.
   Parameters: power (how narrow the rims are), glow, raycolor, grid (lines a unit; 0: none). */
surface xray(float power = 1.8; float glow = 0.9; float grid = 6; float least = 0.06;
             color raycolor = color(0.35, 0.75, 1);) {
    vector V = normalize(-I);
    float facing = abs(normalize(N) . V);
    float rim = pow(1 - facing, power);
    float line = 0;
    if (grid > 0) {
        float z = grid * zcomp(transform("object", P));
        float w = max(abs(Du(z) * du) + abs(Dv(z) * dv), 0.001);
        float d = abs(z - round(z));
        line = clamp((0.04 - d) / w + 0.5, 0, 1) * min(1, 0.12 / w);
    }
    float strength = clamp(least + rim + 0.35 * line, 0, 1);
    Oi = 0.55 * strength;
    Ci = glow * strength * raycolor;
}
