/* marble.sl: veined stone: turbulence of six octaves bends a stack of layers, whose place between
   vein and body picks the color; polished on top. */
surface marble(float Ka = 1; float Kd = 0.8; float Ks = 0.4; float roughness = 0.06;
               float scale = 1; float veining = 5; float layers = 1.6;
               color bodycolor = color(0.93, 0.91, 0.87);
               color midcolor = color(0.62, 0.60, 0.60);
               color veincolor = color(0.13, 0.13, 0.19);
               color specularcolor = 1;) {
    normal Nf = faceforward(normalize(N), I);
    vector V = -normalize(I);
    point Pshade = scale * transform("object", P);

    float turbulence = 0;
    float weight = 1;
    float frequency = 1;
    uniform float octave;
    for (octave = 0; octave < 6; octave += 1) {
        turbulence += weight * abs(2 * float noise(frequency * Pshade) - 1);
        weight *= 0.5;
        frequency *= 2;
    }

    float layer = layers * (xcomp(Pshade) + 0.6 * ycomp(Pshade)) + veining * turbulence;
    float vein = 0.5 + 0.5 * sin(layer);
    vein = vein * vein;
    float fine = smoothstep(0.55, 1.1, turbulence);
    color Ct = mix(veincolor, midcolor, smoothstep(0, 0.14, vein));
    Ct = mix(Ct, bodycolor, smoothstep(0.08, 0.45, vein));
    Ct = mix(Ct, midcolor, 0.35 * fine);

    Oi = Os;
    Ci = Os * (Cs * Ct * (Ka * ambient() + Kd * diffuse(Nf)) +
               specularcolor * Ks * specular(Nf, V, 8 * roughness));
}
