/* agate.sl: a cut agate: bands of quartz that follow the hollow they grew in, in colours from an
   array of knots.
   Parameters: bands, scale, wobble, shift (turns the colours), Ka Kd Ks roughness. */
surface agate(float Ka = 1; float Kd = 0.8; float Ks = 0.6; float roughness = 0.03;
              float bands = 9; float scale = 1.0; float wobble = 0.5; float shift = 0;) {
    color ramp[8] = {color(0.16, 0.05, 0.03), color(0.50, 0.17, 0.06), color(0.82, 0.47, 0.22),
                     color(0.93, 0.83, 0.70), color(0.40, 0.42, 0.50), color(0.09, 0.11, 0.20),
                     color(0.86, 0.82, 0.78), color(0.30, 0.10, 0.05)};
    point Q = scale * transform("object", P);
    vector bend = vector noise(1.2 * Q) - vector(0.5, 0.5, 0.5);
    float field = float noise(1.1 * Q + wobble * 2 * bend) + 0.25 * float noise(2.9 * Q);
    float band = bands * field + 0.05 * float noise(12 * Q);
    /* Fine layers ride on the broad ones; finer than a pixel they are left out. */
    float w = abs(Du(band) * du) + abs(Dv(band) * dv);
    float place = mod(band + shift, 1);
    color Ct = spline("catmull-rom", place, ramp);
    float fine = float noise(14 * band);
    Ct *= mix(0.78 + 0.44 * fine, 1, smoothstep(0.02, 0.08, w));
    /* A druse of crystals fills the middle. */
    float druse = smoothstep(0.80, 0.84, field);
    float sparkle = float cellnoise(30 * Q);
    Ct = mix(Ct, color(0.80, 0.78, 0.86) * (0.5 + 0.7 * sparkle), druse);
    normal Nf = faceforward(normalize(normalize(N) + 0.5 * druse * (vector cellnoise(30 * Q) -
                                                                    vector(0.5, 0.5, 0.5))), I);
    vector V = -normalize(I);
    Oi = Os;
    Ci = Os * (Ct * (Ka * ambient() + Kd * diffuse(Nf)) + Ks * specular(Nf, V, 8 * roughness));
}
