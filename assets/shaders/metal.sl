/* metal.sl: highlights in the metal's own color. */
surface metal(float Ka = 1; float Ks = 1; float roughness = 0.1; color surface_color = 1;) {
    normal Nf = faceforward(normalize(N), I);
    vector V = -normalize(I);
    Oi = Os;
    Ci = Os * Cs * surface_color * (Ka * ambient() + Ks * specular(Nf, V, roughness));
}
