/* glass.sl: clear solid glass: mirrors and bends what is around it by Fresnel's formulas; light
   grows green over a long way through it.
   Parameters: ior (index of refraction), tint (what one object unit lets through), Ks and roughness
   of the lamps' reflections, Kr and Kt of the mirrored and the bent picture. */
surface glass(float Ks = 0.8; float roughness = 0.02; float ior = 1.5; float Kr = 1; float Kt = 1;
              color tint = color(0.86, 0.95, 0.92);) {
    vector In = normalize(I);
    normal Nn = normalize(N);
    normal Nf = faceforward(Nn, In);
    float inside = step(0, In . Nn);
    float eta = mix(1 / ior, ior, inside);

    float kr, kt;
    vector R, T;
    fresnel(In, Nf, eta, kr, kt, R, T);
    kt = 1 - kr;

    float depth = 0;
    rayinfo("depth", depth);
    color mirrored = 0;
    color bent = 0;
    if (depth < 5) {
        if (kr > 0.004)
            mirrored = Kr * kr * color trace(P, R);
        if (kt > 0.004)
            bent = Kt * kt * color trace(P, T);
    }

    /* Leaving the body: the way behind this point was through glass. */
    color through = 1;
    if (inside > 0.5) {
        float way = length(I);
        through = color(pow(tint[0], way), pow(tint[1], way), pow(tint[2], way));
    }
    /* Light on its way to what lies behind is let through by the same share. */
    string kind = "camera";
    rayinfo("type", kind);
    Oi = kind == "transmission" ? 1 - kt * tint : color(1);
    Ci = through * (mirrored + bent) + (1 - inside) * Ks * specular(Nf, -In, 8 * roughness);
}
