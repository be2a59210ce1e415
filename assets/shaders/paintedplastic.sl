/* paintedplastic.sl: plastic with a texture as its color. */
surface paintedplastic(float Ka = 1; float Kd = 0.5; float Ks = 0.5; float roughness = 0.1;
                       color specularcolor = 1; string texturename = ""; color surface_color = 1;) {
    normal Nf = faceforward(normalize(N), I);
    vector V = -normalize(I);
    color Ct = Cs * surface_color;
    if (texturename != "")
        Ct *= color texture(texturename, s, t);
    Oi = Os;
    Ci = Os * (Ct * (Ka * ambient() + Kd * diffuse(Nf)) +
               specularcolor * Ks * specular(Nf, V, roughness));
}
