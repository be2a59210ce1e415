/* smoke.sl: lit smoke, marched from the far end of the ray towards the eye.
   `density` is what one unit of length takes away, `scatter` the part of the lights' colour that
   comes back, `stepsize` the length of a step (shortened where more than `maxsteps` would be
   needed). With frequency > 0 the smoke is in wisps: fbm in the space of its object. */
volume smoke(
    float density = 1;
    float stepsize = 0.1;
    float maxsteps = 200;
    float scatter = 1;
    color smokecolor = 1;
    float frequency = 0;
    float octaves = 3;
    float contrast = 2;
    float lit = 1;
) {
    float way = length(I);
    float steps = clamp(ceil(way / stepsize), 1, maxsteps);
    float len = way / steps;
    vector back = -normalize(I);
    float keep;
    float k, o;
    for (k = 0; k < steps; k += 1) {
        point here = P + back * ((k + 0.5) * len);
        float local = density;
        if (frequency > 0) {
            point q = transform("shader", here) * frequency;
            float sum = 0, size = 1, total = 0;
            for (o = 0; o < octaves; o += 1) {
                sum += size * (2 * noise(q) - 1);
                total += size;
                size *= 0.5;
                q *= 2.03;
            }
            local *= clamp(0.5 + contrast * sum / total, 0, 1);
        }
        color light = 1;
        if (lit != 0) {
            light = 0;
            illuminance (here) {
                light += Cl;
            }
        }
        keep = exp(-local * len);
        Ci = Ci * keep + (1 - keep) * scatter * smokecolor * light;
        Oi = Oi * keep + (1 - keep);
    }
}
