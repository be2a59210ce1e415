/* gloss.sl: moulded plastic: a colored body under a clear coat that mirrors a bright ceiling; the
   part under a height of the rest position may have a second color (the sole of a shoe). */
surface gloss(float Ka = 1; float Kd = 0.75; float Ks = 0.6; float roughness = 0.05;
              color surface_color = color(0.75, 0.08, 0.04);
              color sole_color = color(0.85, 0.83, 0.78); float sole_height = -1000;
              varying point Pref = point "object" (0, 0, 0);) {
    normal Nf = faceforward(normalize(N), I);
    vector V = -normalize(I);
    vector R = normalize(reflect(-V, Nf));
    float up = zcomp(vtransform("world", R));
    float grazing = 0.04 + 0.96 * pow(1 - clamp(Nf . V, 0, 1), 5);
    color sky = ambient();
    color coat = grazing * sky * mix(0.6, 2.5, smoothstep(-0.1, 0.7, up));

    float above = smoothstep(-0.0015, 0.0015, zcomp(transform("object", Pref)) - sole_height);
    color Ct = mix(sole_color, surface_color, above);
    Oi = Os;
    Ci = Os * (Cs * Ct * (Ka * sky + Kd * diffuse(Nf)) + Ks * specular(Nf, V, 8 * roughness) + coat);
}
