/* underwater.sl: deep green water: red is lost first, everything ends in blue-green, bright threads
   of sunlight hang from above.
   Parameters: clarity (how far one sees, units), watercolor, rays (their strength), scale of them. */
volume underwater(float clarity = 9; float rays = 0.5; float scale = 0.8;
                  color watercolor = color(0.008, 0.085, 0.11);) {
    float way = length(I);
    color through = color(exp(-2.4 * way / clarity), exp(-1.0 * way / clarity),
                          exp(-0.8 * way / clarity));
    float shaft = 0;
    uniform float k;
    for (k = 0; k < 8; k += 1) {
        /* Eight places along the way, jittered so that no bands show. */
        point q = transform("world", P - I * ((k + float random()) / 8));
        float x = scale * (xcomp(q) + 0.25 * zcomp(q));
        float y = scale * ycomp(q);
        float caustic = 1 - abs(2 * float noise(x, y + 0.5 * time) - 1);
        shaft += pow(caustic, 5) / 8;
    }
    color water = watercolor * (1 + 6 * rays * shaft);
    Ci = Ci * through + water * (color(1, 1, 1) - through);
    Oi = mix(color(1, 1, 1), Oi, comp(through, 1));
}
