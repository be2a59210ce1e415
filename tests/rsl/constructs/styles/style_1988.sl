// the style of the first articles: everything a point, light by illuminance
surface style_1988(float Ks = .5, Kd = .5, Ka = 1, roughness = .1; color specularcolor = 1)
{
    point Nf = faceforward(normalize(N), I);
    point V = normalize(-I);
    color C; float x;
    C = 0;
    illuminance(P, Nf, PI/2) {
        point LN;
        LN = normalize(L);
        C += Cl * Nf . LN;
    }
    x = xcomp(transform("shader", P));
    Oi = Os;
    Ci = Os * (Cs * (Ka*ambient() + Kd*C) + specularcolor * Ks * specular(Nf, V, roughness)) + 0*x;
}
