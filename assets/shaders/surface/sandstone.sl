/* sandstone.sl: desert rock: layers of many sands, bent, with grains one can nearly feel.
   Parameters: layers (per unit of z), bend, grain, five colours picked by an uneven ramp, Ka Kd. */
surface sandstone(float Ka = 1; float Kd = 0.9; float layers = 3.2; float bend = 0.35;
                  float grain = 0.004;
                  color sands[5] = {color(0.62, 0.36, 0.18), color(0.78, 0.55, 0.33),
                                    color(0.50, 0.22, 0.11), color(0.86, 0.70, 0.50),
                                    color(0.66, 0.40, 0.24)};) {
    point Q = transform("object", P);
    float z = layers * (zcomp(Q) + bend * (float noise(0.9 * Q) - 0.5) +
                        0.05 * float noise(4 * Q));
    float bed = float noise(2.3 * z) * 1.5 - 0.25 + 0.3 * (float noise(11 * z) - 0.5);
    float pick = clamp(bed, 0, 0.999) * 4;
    float index = floor(pick);
    color Ct = mix(sands[index], sands[index + 1], smoothstep(0.3, 0.7, pick - index));
    float width = sqrt(area(P));
    float fine = mix(float noise(90 * Q), 0.5, smoothstep(0.004, 0.012, width));
    Ct *= 0.8 + 0.4 * fine;
    float ledge = float noise(3.1 * z) + 0.3 * float noise(12 * z);
    normal Nn = calculatenormal(P + (grain * fine + 0.035 * ledge) * normalize(N));
    normal Nf = faceforward(normalize(Nn), I);
    Oi = Os;
    Ci = Os * Ct * (Ka * ambient() + Kd * diffuse(Nf));
}
