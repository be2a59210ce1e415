/* rustymetal.sl: painted iron that rusts: flakes of paint lift off, bare metal shows at their
   borders, and rust eats inwards and runs down.
   Parameters: rust (0 new .. 1 eaten), scale, the colours of paint, rust and metal, Ka Kd Ks. */
#define OCTAVES 6

surface rustymetal(float Ka = 1; float Kd = 0.8; float Ks = 0.5; float rust = 0.48;
                   float scale = 1.6; float roughness = 0.12;
                   color paintcolor = color(0.10, 0.30, 0.33);
                   color rustcolor = color(0.40, 0.14, 0.035);
                   color darkrust = color(0.12, 0.045, 0.025);
                   color metalcolor = color(0.36, 0.36, 0.38);) {
    point Q = scale * transform("object", P);
    /* Rain runs down: the field is stretched along the object's z. */
    point Qrun = point(xcomp(Q), ycomp(Q), 0.45 * zcomp(Q));
    float value = 0;
    float weight = 0.5;
    float width = scale * sqrt(area(P));
    float frequency = 1.3;
    uniform float octave;
    for (octave = 0; octave < OCTAVES; octave += 1) {
        float fade = 1 - smoothstep(0.3, 1, width * frequency);
        value += weight * fade * (float noise(frequency * Qrun) - 0.5);
        weight *= 0.62;
        frequency *= 2.1;
    }
    float eaten = value + 0.9 * (rust - 0.5);
    float bare = smoothstep(0.004, 0.012, eaten);
    float deep = smoothstep(0.008, 0.06, eaten);
    float pits = float noise(38 * Q) * deep;

    /* Paint is a film with an edge; rust is a crust. */
    normal Nn = normalize(N) - normalize(calculatenormal(P)) +
        normalize(calculatenormal(P + normalize(N) * (0.014 * (1 - bare) + 0.012 * deep * pits)));
    normal Nf = faceforward(normalize(Nn), I);
    vector V = -normalize(I);

    color crust = mix(rustcolor, darkrust, smoothstep(0.35, 0.75, float noise(5.7 * Q)));
    crust = mix(crust, color(0.55, 0.25, 0.07), 0.5 * smoothstep(0.55, 0.8, float noise(17 * Q)));
    float stain = smoothstep(-0.22, 0, eaten) * 0.5;
    color Ct = mix(mix(paintcolor, rustcolor, stain), metalcolor, bare);
    Ct = mix(Ct, crust, deep);
    float gloss = mix(mix(0.6, 1, bare), 0.05, deep);
    Oi = Os;
    Ci = Os * (Ct * (Ka * ambient() + Kd * diffuse(Nf)) +
               Ks * gloss * specular(Nf, V, 8 * mix(roughness, 0.25, deep)));
}
