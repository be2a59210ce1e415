/* water.sl: the calm surface of a pool, with wind ripples in the normal alone; it mirrors by
   Fresnel and darkens to the colour of deep water where one looks down.
   Parameters: ripple (height), scale (ripples per unit), deepcolor, Ks and roughness of glints. */
surface water(float Ks = 1; float roughness = 0.015; float ripple = 0.035; float scale = 2.1;
              color deepcolor = color(0.008, 0.055, 0.075);
              color shallowcolor = color(0.05, 0.24, 0.25);) {
    /* Ripples fade where they are smaller than a pixel. */
    point Q = scale * transform("world", P);
    float width = scale * sqrt(area(P));
    float height = 0;
    float size = 1;
    uniform float octave;
    for (octave = 0; octave < 5; octave += 1) {
        float fade = 1 - smoothstep(0.25, 0.8, width / size);
        if (fade <= 0)
            break;
        point q = Q / size;
        height += size * fade * (1 - 2 * abs(float noise(q + 0.7 * vector(time, octave, 0)) - 0.5));
        size *= 0.52;
    }
    normal Nn = calculatenormal(P + ripple * height * normalize(N));
    vector In = normalize(I);
    normal Nf = faceforward(normalize(Nn), In);

    float kr, kt;
    fresnel(In, Nf, 1 / 1.33, kr, kt);
    vector R = reflect(In, Nf);
    /* No mirror image from under the surface. */
    normal flat = faceforward(normalize(N), In);
    R += max(0, 0.02 - R . flat) * vector flat;
    color sky = trace(P, normalize(R));
    float down = clamp(-(In . Nf), 0, 1);
    color body = mix(shallowcolor, deepcolor, down) * (ambient() + 0.6 * diffuse(Nf) + 0.15);
    Oi = Os;
    Ci = Os * (kr * sky + (1 - kr) * body + Ks * specular(Nf, -In, 8 * roughness));
}
