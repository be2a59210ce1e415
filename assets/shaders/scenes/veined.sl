/* veined.sl: marble by turbulence: the sum of noises of rising frequency, sharpened into veins. */
surface veined(float Ka = 1; float Kd = 0.85; float Ks = 0.45; float roughness = 0.07;
               float scale = 1; float octaves = 6; float threshold = 0.42; float sharpness = 4.5;
               color bodycolor = color(0.70, 0.62, 0.55);
               color veincolor = color(0.28, 0.07, 0.05);) {
    normal Nf = faceforward(normalize(N), I);
    vector V = -normalize(I);
    point Pshade = 4 * scale * transform("object", P);

    float turbulence = 0;
    float weight = 0.5;
    uniform float octave;
    for (octave = 0; octave < octaves; octave += 1) {
        turbulence += 2 * weight * abs(0.5 - float noise(Pshade));
        Pshade *= 2;
        weight *= 0.5;
    }

    /* Where turbulence is low two octaves cross: the vein. */
    float body = clamp((turbulence - 0.25 * threshold) * sharpness, 0, 1);
    color Ct = mix(veincolor, bodycolor, body);

    float grazing = pow(1 - clamp(Nf . V, 0, 1), 5);
    Oi = Os;
    Ci = Os * (Cs * Ct * (Ka * ambient() + Kd * diffuse(Nf)) +
               (Ks + 0.5 * grazing) * specular(Nf, V, 8 * roughness) + 0.6 * grazing * ambient());
}
