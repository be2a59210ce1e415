/* porcelain.sl: a pale, half-glossy body that shows the form of whatever wears it.
   Parameters: as plastic, with a rim that brightens (sheen). */
surface porcelain(float Ka = 1; float Kd = 0.72; float Ks = 0.3; float roughness = 0.09;
                  float sheen = 0.25; color surface_color = color(0.86, 0.78, 0.68);) {
    normal Nf = faceforward(normalize(N), I);
    vector V = -normalize(I);
    float rim = pow(1 - clamp(Nf . V, 0, 1), 4);
    Oi = Os;
    Ci = Os * (surface_color * (Ka * ambient() + Kd * diffuse(Nf)) + sheen * rim * ambient() +
               Ks * specular(Nf, V, 8 * roughness));
}
