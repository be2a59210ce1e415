/* glossy.sl: lacquer: a cone of gathered rays mirrors the surroundings, blurred; rays that meet
   nothing see the sky.
   Parameters: Kd, Kr (of the mirrored picture), blur (radians), samples, maxdepth, sky, ground. */
surface glossy(float Kd = 0.35; float Kr = 0.6; float blur = 0.12; float samples = 16;
               float maxdepth = 2; color sky = color(0.55, 0.68, 0.85);
               color ground = color(0.28, 0.25, 0.22);) {
    normal Nf = faceforward(normalize(N), I);
    vector way = reflect(normalize(I), Nf);
    color seen = 0, sum = 0;
    vector ray = 0;
    if (raydepth() < maxdepth) {
        gather("illuminance", P, way, blur, samples, "surface:Ci", seen, "ray:direction", ray,
               "label", "gloss") {
            sum += seen;
        } else {
            vector w = normalize(vtransform("world", ray));
            sum += mix(ground, sky, smoothstep(-0.2, 0.2, ycomp(w)));
        }
        sum /= samples;
    }
    Oi = Os;
    Ci = Oi * (Cs * Kd * (ambient() + diffuse(Nf)) + Kr * sum);
}
