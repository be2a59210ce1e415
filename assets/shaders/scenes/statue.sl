/* statue.sl: pale veined marble for things that move: the stone is cut from the rest position, so
   the veins go where the skin goes. */
float turbulence(point p; uniform float octaves) {
    float sum = 0;
    float weight = 1;
    float frequency = 1;
    uniform float octave;
    for (octave = 0; octave < octaves; octave += 1) {
        sum += weight * abs(2 * float noise(frequency * p) - 1);
        weight *= 0.5;
        frequency *= 2.03;
    }
    return sum;
}

surface statue(float Ka = 1; float Kd = 0.85; float Ks = 0.3; float roughness = 0.08;
               float scale = 5; float veining = 0.85;
               color bodycolor = color(0.78, 0.74, 0.68);
               color cloudcolor = color(0.55, 0.54, 0.53);
               color veincolor = color(0.12, 0.12, 0.15);
               color sheencolor = color(0.9, 0.95, 1);
               varying point Pref = point "object" (0, 0, 0);) {
    normal Nf = faceforward(normalize(N), I);
    vector V = -normalize(I);
    point Pshade = scale * transform("object", Pref);

    /* Veins run where a bent field crosses its middle; clouds are its slow part. */
    float bend = turbulence(Pshade, 6);
    float field = float noise(1.1 * Pshade + 0.9 * bend * vector(1, 0.5, -0.7));
    float vein = 1 - smoothstep(0, 0.06, abs(field - 0.5));
    vein *= smoothstep(0.28, 0.52, float noise(1.7 * Pshade + vector(7, 3, 5)));
    float cloud = smoothstep(0.3, 0.85, bend);
    color Ct = mix(bodycolor, cloudcolor, cloud);
    Ct = mix(Ct, veincolor, veining * vein);

    /* The polish mirrors more at grazing angles (Schlick). */
    float grazing = pow(1 - clamp(Nf . V, 0, 1), 5);
    Oi = Os;
    Ci = Os * (Cs * Ct * (Ka * ambient() + Kd * diffuse(Nf)) +
               (Ks + 0.5 * grazing) * specular(Nf, V, 8 * roughness) +
               0.35 * grazing * sheencolor * ambient());
}
