/* planet.sl: a blue planet: continents by fractal noise, climate by latitude, ice, shining seas, a
   thin bright air at the edge.
   Parameters: scale, sealevel 0..1, octaves, ice (how far the caps reach), Ka Kd Ks, air. */
surface planet(float Ka = 0.6; float Kd = 1.1; float Ks = 0.5; float roughness = 0.12;
               float scale = 1.25; float sealevel = 0.52; float octaves = 8; float ice = 0.30;
               float clouds = 0.8; float air = 0.8;
               color aircolor = color(0.30, 0.55, 1);) {
    float fractal(point p; uniform float n; float width;) {
        float sum = 0;
        float weight = 0.5;
        float size = 1;
        uniform float i;
        for (i = 0; i < n; i += 1) {
            sum += weight * mix(float noise(size * p), 0.5, smoothstep(0.3, 1, width * size));
            weight *= 0.52;
            size *= 2.07;
        }
        return sum;
    }
    point Q = normalize(transform("object", P) - point(0, 0, 0));
    point Qs = scale * Q + vector(2.1, 0.4, 5.3);
    float width = scale * sqrt(area(P));
    float land = fractal(Qs, octaves, width) / 1.02;
    float latitude = abs(zcomp(Q));
    float cold = latitude + 0.25 * (fractal(3 * Qs, 4, 3 * width) - 0.5);

    float shore = sealevel;
    float height = (land - shore) / (1 - shore);
    color ground = spline(clamp(height * 3.4, 0, 1), color(0.62, 0.54, 0.33), color(0.62, 0.54, 0.33),
                          color(0.14, 0.26, 0.05), color(0.10, 0.19, 0.04),
                          color(0.34, 0.25, 0.13), color(0.42, 0.36, 0.28), color(0.80, 0.80, 0.80),
                          color(0.9, 0.9, 0.9));
    float desert = smoothstep(0.18, 0.30, latitude) * (1 - smoothstep(0.34, 0.5, latitude));
    ground = mix(ground, color(0.58, 0.42, 0.20), 0.75 * desert);
    float deep = clamp((shore - land) * 7, 0, 1);
    color sea = mix(color(0.04, 0.26, 0.34), color(0.006, 0.03, 0.14), sqrt(deep));
    float coast = smoothstep(-0.004 - 0.4 * width, 0.004 + 0.4 * width, land - shore);
    color Ct = mix(sea, ground, coast);
    float frozen = smoothstep(1 - ice, 1.05 - ice, cold + 0.12 * height);
    Ct = mix(Ct, color(0.88, 0.92, 0.95), frozen);

    vector swirl = vector noise(1.8 * Q) - vector(0.5, 0.5, 0.5);
    float cover = fractal(2.2 * Q + 0.9 * swirl + vector(7, 0, 0.05 * time), 7, 2 * width);
    cover = clouds * smoothstep(0.55, 0.70, cover);

    normal Nf = faceforward(normalize(N), I);
    vector V = -normalize(I);
    color lit = Ka * ambient() + Kd * diffuse(Nf);
    float rim = pow(1 - clamp(Nf . V, 0, 1), 3);
    Oi = Os;
    Ci = Os * (mix(Ct, color(0.92, 0.93, 0.95), cover) * lit +
               Ks * (1 - coast) * (1 - cover) * (1 - frozen) * specular(Nf, V, 8 * roughness) +
               air * rim * aircolor * lit);
}
