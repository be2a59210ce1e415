// early 2000s: gather, occlusion, output messages
surface style_gather_era(uniform float samples = 32; uniform string envmap = ""; uniform float Kocc = 1; uniform string __mode = "occ";
    output varying float _occ = 0; output varying color _refl = color(0);) {
    normal Nn = normalize(N);
    vector In = normalize(I);
    normal Nf = faceforward(Nn, In, Nn);
    varying vector envdir = 0;
    uniform float raydepth; rayinfo("depth", raydepth);
    if (raydepth < 1 && Kocc > 0) _occ = occlusion(P, Nf, samples, "environmentdir", envdir, "distribution", "cosine");
    if (envmap != "") _refl = color environment(envmap, vtransform("current", "world", envdir));
    color c = diffuse(Nf) * (1 - _occ * Kocc);
    Ci = Os * Cs * c + _refl; Oi = Os;
}
