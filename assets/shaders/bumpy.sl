/* bumpy.sl: a relief from an image: where it is bright the surface is raised by `amplitude`. */
displacement bumpy(float amplitude = 0.05; string texturename = "";) {
    if (texturename != "")
        P += amplitude * float texture(texturename, s, t) * normalize(N);
    N = calculatenormal(P);
}
