/* bumpmapped.sl: moulded plastic whose relief comes from an image, in the normal alone; without one
   it has a leathery grain. Close up, the image's own resolution limits how deep it may be.
   Parameters: bumpname, depth, repeats in s and t, surface_color, Ka Kd Ks roughness. */
surface bumpmapped(float Ka = 1; float Kd = 0.75; float Ks = 0.45; float roughness = 0.08;
                   string bumpname = ""; float depth = 0.04; float srepeat = 4; float trepeat = 2;
                   color surface_color = color(0.12, 0.24, 0.34);) {
    normal Nn = normalize(N);
    if (bumpname != "") {
        float size[2] = {256, 256};
        float known = textureinfo(bumpname, "resolution", size);
        float limit = known == 1 ? min(1, size[0] / 64) : 1;
        /* Steeper where the same height has a shorter way along s and t. */
        Nn = bump(bumpname, Nn, dPdu / (srepeat * depth * limit), dPdv / (trepeat * depth * limit),
                  srepeat * s, trepeat * t);
    } else {
        point Q = 9 * transform("object", P);
        Nn = calculatenormal(P + depth * 0.5 * float noise(Q + 2 * vector noise(0.5 * Q)) * Nn);
    }
    normal Nf = faceforward(normalize(Nn), I);
    vector V = -normalize(I);
    Oi = Os;
    Ci = Os * (surface_color * (Ka * ambient() + Kd * diffuse(Nf)) + Ks * specular(Nf, V, 8 * roughness));
}
