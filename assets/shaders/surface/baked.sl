/* baked.sl: matte whose light is kept in a point file: baked into `write` if that is given, or
   taken from `read`, so that later frames need not compute it; `map` keeps it by s and t instead.
   Parameters: Kd, read, write and map (point files; "": none). */
surface baked(float Kd = 0.9; string read = ""; string write = ""; string map = "";) {
    normal Nf = faceforward(normalize(N), I);
    color light = 0;
    float known = 0;
    if (read != "")
        known = texture3d(read, P, Nf, "_light", light);
    if (known == 0)
        light = ambient() + diffuse(Nf);
    if (write != "")
        bake3d(write, "_light", P, Nf, "_light", light, "interpolate", 1);
    if (map != "")
        bake(map, s, t, light);
    Oi = Os;
    Ci = Oi * Cs * Kd * light;
}
