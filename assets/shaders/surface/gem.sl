/* gem.sl: a cut stone: facets are flat pieces of the normal; inside, light is bent twice and comes
   back in splinters of colour.
   Parameters: facets (around and along), ior, dispersion, gemcolor, Kr Ks roughness. */
surface gem(float Ks = 1; float roughness = 0.01; float Kr = 1; float facets = 18; float ior = 1.9;
            float dispersion = 0.06; color gemcolor = color(0.75, 0.05, 0.16);) {
    vector In = normalize(I);
    /* A facet's normal: that of the middle of its cell in s, t, shifted row by row. */
    float row = floor(facets * t);
    float column = floor(facets * s + 0.5 * mod(row, 2));
    float ds = (column + 0.5 - 0.5 * mod(row, 2)) / facets - s;
    float dt = (row + 0.5) / facets - t;
    normal Nfacet = N + ds * Du(N) + dt * Dv(N);
    normal Nf = faceforward(normalize(Nfacet), I);

    float kr, kt;
    vector R, T;
    fresnel(In, Nf, 1 / ior, kr, kt, R, T);
    color mirrored = trace(P, R);

    /* The inside: a light path that meets a back facet and returns; colours part a little. */
    float splinter(vector d; uniform float k) {
        vector q = vtransform("object", d);
        point cell = point(6 * xcomp(q), 6 * ycomp(q), 6 * zcomp(q)) + vector(3.1 * k, row, column);
        float bright = float cellnoise(cell);
        return pow(bright, 6) * 1.8 + 0.25 * float cellnoise(cell + vector(9, 9, 9));
    }
    color fire = 0;
    vector Tr = normalize(refract(In, Nf, 1 / (ior - dispersion)));
    vector Tb = normalize(refract(In, Nf, 1 / (ior + dispersion)));
    fire = color(splinter(Tr, 0), splinter(normalize(T), 0), splinter(Tb, 0));
    fire += 0.5 * color(splinter(reflect(Tr, Nf), 1), splinter(reflect(normalize(T), Nf), 1),
                        splinter(reflect(Tb, Nf), 1));
    color body = mix(gemcolor, color(1, 1, 1), 0.06) * fire * (ambient() * 1.5 + 0.6 * diffuse(Nf) + 0.25);
    Oi = Os;
    Ci = Os * ((1 - kr) * (body + 0.12 * gemcolor) + Kr * kr * mirrored +
               Ks * specular(Nf, -In, 8 * roughness));
}
