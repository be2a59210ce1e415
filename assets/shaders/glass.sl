// Clear glass: mirrored and refracted rays by Fresnel's shares, tinted by the way inside, where only
// total reflection is followed. Light on its way to other surfaces passes by the same tint.
surface glass(float eta = 1.5; color tint = color(0.86, 0.97, 0.93); float density = 0.4;
              float Ks = 0.6; float roughness = 0.01; float maxdepth = 7;)
{
    normal n = normalize(N);
    vector i = normalize(I);
    float outside = i . n < 0 ? 1 : 0;
    normal Nf = outside > 0 ? n : -n;
    float kr, kt;
    vector reflected, refracted;
    fresnel(i, Nf, outside > 0 ? 1 / eta : eta, kr, kt, reflected, refracted);
    if (refracted . refracted == 0) { kr = 1; kt = 0; }  // total reflection
    else kt = 1 - kr;

    string kind = "camera";
    float depth = 0;
    rayinfo("type", kind);
    rayinfo("depth", depth);
    color passed = 1;
    if (outside == 0) {
        float way = density * length(I);
        passed = color(pow(comp(tint, 0), way), pow(comp(tint, 1), way), pow(comp(tint, 2), way));
    }
    Oi = 1;
    if (kind == "transmission") Oi = 1 - tint * kt;
    Ci = 0;
    if (depth < maxdepth) {
        if (outside > 0) Ci = kr * trace(P, reflected) + kt * trace(P, refracted);
        else Ci = passed * trace(P, kt > 0 ? refracted : reflected);
    }
    if (outside > 0) Ci += Ks * specular(Nf, -i, roughness);
}
