// fresnel, refraction and reflection by trace and environment
surface style_1990s_glass(float Ka = 0.2, Kd = 0, Ks = 0.5, Kr = 1, Kt = 1, roughness = 0.05, eta = 1.5;
                          string envname = ""; color transmitcolor = 1;) {
    vector IN = normalize(I), Rfldir, Rfrdir;
    normal Nn = normalize(N), Nf = faceforward(Nn, IN);
    float kr, kt;
    color ev = 0;
    fresnel(IN, Nf, (IN.Nn < 0) ? 1 / eta : eta, kr, kt, Rfldir, Rfrdir);
    kt = 1 - kr;
    if (Kr * kr > 0.001) { if (envname != "") ev = Kr * kr * color environment(envname, vtransform("world", Rfldir));
        else ev = Kr * kr * trace(P, normalize(Rfldir)); }
    color refr = 0;
    if (Kt * kt > 0.001) refr = Kt * kt * transmitcolor * trace(P, normalize(Rfrdir));
    Oi = 1;
    Ci = Cs * Kd * diffuse(Nf) + Ka * ambient() + ev + refr + Ks * specular(Nf, -IN, roughness);
}
