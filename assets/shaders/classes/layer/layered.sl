/* layered.sl: a material of co-shaders. `base` paints first, each of `layers` over what it finds; all
   have a method paint(). displacement() runs them once: the height bends the normal, and the lights
   read the rest.
   Parameters: base, layers (handles), bump, clear (share of light that mirrors at grazing angles). */
class layered(shader base = null; shader layers[] = {}; float bump = 0.06; float clear = 1;) {
    varying color tint = color(0.5, 0.5, 0.5);
    varying float gloss = 0.2;
    varying float rough = 0.2;
    varying float metal = 0;
    varying float height = 0;

    public void displacement(output point P; output normal N) {
        point Q = transform("object", P);
        vector up = vtransform("world", vector(normalize(N)));
        float k;
        if (base != null) base->paint(Q, up, tint, gloss, rough, metal, height);
        for (k = 0; k < arraylength(layers); k += 1)
            layers[k]->paint(Q, up, tint, gloss, rough, metal, height);
        P += bump * height * normalize(N);
        N = calculatenormal(P);
    }
    public void diffuselighting(output color Ci, Oi) {
        normal Nf = faceforward(normalize(N), I);
        Ci = Oi * tint * (1 - metal) * (ambient() + diffuse(Nf));
    }
    public void specularlighting(output color Ci, Oi) {
        normal Nf = faceforward(normalize(N), I);
        vector V = -normalize(I);
        float grazing = pow(1 - max(0, Nf . V), 5);
        color shine = mix(color(gloss), tint, metal);
        Ci += Oi * shine * (specular(Nf, V, rough) + 0.5 * metal * (ambient() + 0.6 * diffuse(Nf)));
        color mirrored = trace(P, reflect(normalize(I), Nf));
        Ci += Oi * mirrored * mix(0.6 * shine * (1 - rough), color(clear * (1 - rough)), grazing);
    }
}
