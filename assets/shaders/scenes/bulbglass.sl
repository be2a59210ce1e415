/* bulbglass.sl: thin clear glass: seen only where it mirrors, at its rim and in highlights. */
surface bulbglass(float Ks = 0.9; float roughness = 0.02; color tint = color(0.80, 0.88, 0.90);) {
    normal Nf = faceforward(normalize(N), I);
    vector V = -normalize(I);
    float grazing = pow(1 - clamp(Nf . V, 0, 1), 3);
    color mirrored = tint * (0.05 + 0.6 * grazing) * (ambient() + 0.25 * diffuse(Nf));
    Oi = color(0.03, 0.03, 0.03) + 0.42 * grazing;
    Ci = mirrored + Ks * specular(Nf, V, 8 * roughness);
}
