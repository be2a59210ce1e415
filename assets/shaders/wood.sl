/* wood.sl: growth rings around the z axis of the object, disturbed by noise, with fine grain. */
surface wood(float Ka = 1; float Kd = 0.85; float Ks = 0.25; float roughness = 0.15;
             float ringscale = 8; float wobble = 0.35; float grainscale = 60;
             color lightwood = color(0.63, 0.40, 0.20);
             color darkwood = color(0.33, 0.16, 0.06);
             color specularcolor = color(1, 0.95, 0.85);) {
    normal Nf = faceforward(normalize(N), I);
    vector V = -normalize(I);
    point Pshade = transform("object", P);

    /* Rings are not round: the trunk wanders and swells. */
    vector wander = wobble * (vector noise(0.7 * Pshade) - vector(0.5, 0.5, 0.5));
    point Pring = Pshade + wander;
    float x = xcomp(Pring);
    float y = ycomp(Pring);
    float r = sqrt(x * x + y * y) * ringscale;
    r += 0.3 * float noise(1.5 * Pring);

    /* Early wood is pale and wide, late wood dark and thin; the edge inwards is sharp. */
    float ring = mod(r, 1);
    float late = smoothstep(0.3, 0.85, ring) * (1 - smoothstep(0.92, 1, ring));
    float year = float cellnoise(floor(r));
    late *= 0.6 + 0.4 * year;

    /* Fibres run along the trunk. */
    point Pgrain = point(xcomp(Pshade) * grainscale, ycomp(Pshade) * grainscale,
                         zcomp(Pshade) * grainscale * 0.06);
    float grain = float noise(Pgrain);
    grain = 0.75 + 0.35 * grain;
    float pores = smoothstep(0.62, 0.75, float noise(2.3 * Pgrain));

    color Ct = mix(lightwood, darkwood, late) * grain;
    Ct = mix(Ct, 0.6 * darkwood, 0.4 * pores);

    Oi = Os;
    Ci = Os * (Cs * Ct * (Ka * ambient() + Kd * diffuse(Nf)) +
               specularcolor * Ks * (1 - 0.6 * late) * specular(Nf, V, 8 * roughness));
}
