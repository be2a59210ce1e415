/* wetstone.sl: pebbles under a film of water: it asks the other shaders of its surface about what
   they did (the displacement's depth, the volume inside), and the renderer about itself.
   Parameters: wetness, scale of the pebbles' speckles, stonecolor, Ka Kd Ks roughness. */
surface wetstone(float Ka = 1; float Kd = 0.7; float Ks = 0.8; float roughness = 0.03;
                 float wetness = 0.8; float speckles = 22; color stonecolor = color(0.30, 0.27, 0.24);) {
    float Km = 0;
    float density = 0;
    float fogdistance = 0;
    string renderer = "";
    string identifier = "";
    displacement("Km", Km);
    incident("density", density);
    opposite("density", density);
    float airy = atmosphere("distance", fogdistance);
    rendererinfo("renderer", renderer);
    attribute("identifier:name", identifier);
    float own = 0;
    surface("speckles", own);

    point Q = transform("object", P);
    setxcomp(Q, xcomp(Q) + 0.1 * float noise(3 * Q));
    setycomp(Q, ycomp(Q) + 0.1 * float noise(3 * Q + vector(5, 5, 5)));
    vector drift = vector noise(1.5 * Q) - vector(0.5, 0.5, 0.5);
    float vein = 1 - smoothstep(0, 0.06, abs(float noise(1.4 * Q + 0.4 * drift) - 0.5));
    color Ct = stonecolor * (0.6 + 0.8 * float noise(2 * Q));
    Ct = mix(Ct, color(0.72, 0.70, 0.66), 0.8 * vein);
    Ct *= 0.75 + 0.5 * float noise(speckles * Q);
    /* Wet stone is darker and more colourful. */
    color wetcolor = color(pow(Ct[0], 1.5), pow(Ct[1], 1.55), pow(Ct[2], 1.6)) * 1.15;
    float film = wetness * smoothstep(-0.6 - Km, 0.1, 0.9 - abs(zcomp(Q)) + 0.4 * float noise(2 * Q));
    Ct = mix(Ct, wetcolor, film);
    normal Nf = faceforward(normalize(N), I);
    normal Nwater = normalize(Nf + 0.06 * (vector noise(4 * Q) - vector(0.5, 0.5, 0.5)));
    vector In = normalize(I);
    float kr = film * (0.03 + 0.97 * pow(1 - clamp(-(Nwater . In), 0, 1), 5));
    Oi = Os;
    Ci = Os * (Ct * (Ka * ambient() + Kd * diffuse(Nf)) + kr * trace(P, reflect(In, Nwater)) +
               film * Ks * specular(Nwater, -In, 8 * roughness));
    if (airy == 1 && fogdistance > 0)
        Ci *= 1 - 0.2 * exp(-fogdistance);
}
