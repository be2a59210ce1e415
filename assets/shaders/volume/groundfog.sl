/* groundfog.sl: mist that lies in the hollows: its density falls off exponentially with height, so
   the way through it has a closed form and costs nothing.
   Parameters: density at the ground, falloff (per unit of height), ground (its height), fogcolor. */
volume groundfog(float density = 0.28; float falloff = 1.1; float ground = 0;
                 color fogcolor = color(0.72, 0.76, 0.80);) {
    point eye = transform("world", P - I);
    point end = transform("world", P);
    float way = distance(eye, end);
    float z0 = zcomp(eye) - ground;
    float dz = zcomp(end) - zcomp(eye);
    float k = falloff * dz;
    /* The mean of exp(-falloff * z) along the way. */
    float mean;
    if (abs(k) > 0.0001)
        mean = exp(-falloff * z0) * (1 - exp(-k)) / k;
    else
        mean = exp(-falloff * z0);
    float through = exp(-density * way * max(mean, 0));
    Ci = mix(fogcolor, Ci, through);
    Oi = mix(color(1, 1, 1), Oi, through);
}
