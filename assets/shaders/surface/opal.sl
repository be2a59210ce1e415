/* opal.sl: a milky stone with patches of pure colour that flash and change as one moves.
   Parameters: patches (per unit), fire 0..1, milk, Ka Kd Ks roughness. */
surface opal(float Ka = 1; float Kd = 0.55; float Ks = 0.5; float roughness = 0.04;
             float patches = 5; float fire = 1.1; color milk = color(0.66, 0.72, 0.78);) {
    normal Nf = faceforward(normalize(N), I);
    vector V = -normalize(I);
    point Q = patches * transform("object", P);
    color flash = 0;
    uniform float layer;
    for (layer = 0; layer < 3; layer += 1) {
        point q = Q * (1 + 0.6 * layer) + 2.2 * (vector noise(0.9 * Q + vector(layer, 0, 0)) -
                                                 vector(0.5, 0.5, 0.5));
        /* A grating in each patch leans its own way: its colour depends on where one stands. */
        vector axis = normalize(vector cellnoise(q + vector(0, 7 * layer, 0)) - vector(0.5, 0.5, 0.5));
        float path = abs(axis . (V + Nf));
        float hue = mod(1.9 * path + float cellnoise(q) * 0.3, 1);
        float strong = pow(float cellnoise(q + vector(3, 3, 3)), 2);
        flash += strong * ctransform("hsv", "rgb", color(hue, 0.9, 1)) / (1 + 0.5 * layer);
    }
    float facing = clamp(Nf . V, 0, 1);
    color light = Ka * ambient() + Kd * diffuse(Nf);
    Oi = Os;
    Ci = Os * (milk * light + fire * flash * (0.25 + facing) * (0.5 * light + 0.12) +
               Ks * specular(Nf, V, 8 * roughness));
}
