/* jade.sl: carved jade or wax: light sinks in and glows in thin parts and at the terminator.
   Parameters: bodycolor, deepcolor, translucence, Ka Kd Ks roughness, cloudiness. */
surface jade(float Ka = 1; float Kd = 0.55; float Ks = 0.6; float roughness = 0.04;
             float translucence = 0.55; float cloudiness = 0.6; float Kr = 0.7;
             color bodycolor = color(0.22, 0.52, 0.30); color deepcolor = color(0.03, 0.20, 0.10);) {
    normal Nf = faceforward(normalize(N), I);
    vector In = normalize(I);
    point Q = transform("object", P);
    float cloud = 0.6 * float noise(2.2 * Q) + 0.4 * float noise(5.5 * Q + 0.6 * vector noise(3 * Q));
    color Ct = mix(deepcolor, bodycolor, smoothstep(0.5 - 0.35 * cloudiness, 0.5 + 0.3 * cloudiness, cloud));
    Ct = mix(Ct, color(0.72, 0.82, 0.66), 0.35 * smoothstep(0.6, 0.78, cloud));

    /* Light that entered elsewhere: wrapped around, and through from behind. */
    color inside = 0;
    illuminance(P + 0.2 * Nf, Nf, PI) {
        vector Ln = normalize(L);
        float wrapped = clamp(0.5 + 0.5 * (Ln . Nf), 0, 1);
        float behind = pow(clamp(-(Ln . -In), 0, 1), 3);
        inside += Cl * (wrapped * wrapped + 0.8 * behind);
    }
    float facing = clamp(-(Nf . In), 0, 1);
    float kr = Kr * (0.05 + 0.95 * pow(1 - facing, 5));
    Oi = Os;
    Ci = Os * (Ct * (Ka * ambient() * 1.3 + Kd * diffuse(Nf) +
                     translucence * inside * mix(color(1, 1, 1), color(0.7, 1, 0.6), 0.5)) +
               kr * trace(P, reflect(In, Nf)) + Ks * specular(Nf, -In, 8 * roughness));
}
