/* frost.sl: frosted metal or satin glass: a blurred mirror image gathered by many rays.
   Parameters: samples, blur (the cone's half angle in degrees), Kr, Ka Kd Ks, tint. */
surface frost(float Ka = 0.6; float Kd = 0.25; float Ks = 0.4; float Kr = 0.8; float samples = 16;
              float blur = 14; float roughness = 0.2; color tint = color(0.75, 0.80, 0.84);) {
    normal Nf = faceforward(normalize(N), I);
    vector In = normalize(I);
    vector R = reflect(In, Nf);
    float depth = raylevel();
    color sum = 0;
    float hits = 0;
    float misses = 0;
    if (depth < 2 && isshadowray() == 0) {
        color seen = 0;
        float way = 0;
        gather("illuminance", P, R, radians(blur), depth > 0 ? 2 : samples, "surface:Ci", seen,
               "ray:length", way, "distribution", "cosine") {
            sum += seen / (1 + 0.05 * way);
            hits += 1;
        } else {
            sum += color(0.05, 0.055, 0.06);
            misses += 1;
        }
        sum /= max(hits + misses, 1);
    }
    float facing = clamp(-(Nf . In), 0, 1);
    Oi = Os;
    Ci = Os * tint * (Ka * ambient() + Kd * diffuse(Nf) + Kr * (0.55 + 0.45 * (1 - facing)) * sum +
                      Ks * specular(Nf, -In, 8 * roughness));
}
