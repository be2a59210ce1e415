/* cloudplane.sl: fair-weather clouds on a ball or a plane of sky: heaps with lit tops on blue; in
   holes the sky may be clear (opacity 0) so that it can hang before anything.
   Parameters: scale, cover 0..1, sharpness, clear (1: no sky between), cloud and sky colours. */
surface cloudplane(float scale = 1.7; float cover = 0.58; float sharpness = 4; float clear = 0;
                   float detail = 7; color skycolor = color(0.13, 0.32, 0.72);
                   color horizoncolor = color(0.52, 0.68, 0.88);
                   color cloudcolor = color(1, 0.99, 0.97); color undercolor = color(0.52, 0.55, 0.62);
                   float wind = 0.2;) {
    float heap(point p; float width) {
        float sum = 0;
        float weight = 0.5;
        float size = 1;
        uniform float i = 0;
        for (; i < detail; i += 1) {
            sum += weight * mix(float noise(p * size), 0.5, smoothstep(0.3, 1, width * size));
            weight *= 0.5;
            size *= 2.17;
        }
        return sum;
    }
    point Q = scale * transform("object", P) + time * vector(wind, 0, 0);
    Q += 0.35 * (vector noise(1.1 * Q) - vector(0.5, 0.5, 0.5));
    float width = scale * sqrt(area(P));
    float here = heap(Q, width);
    /* The same field towards the sun: where it is thinner there, this side is lit. */
    float sunwards = heap(Q + vector(-0.12, -0.1, 0.16), width);
    float dense = clamp(sharpness * (here - 1 + cover) * 2, 0, 1);
    dense = dense * dense * (3 - 2 * dense);
    float lit = clamp(0.62 + 6 * (here - sunwards), 0, 1);
    color sky = mix(horizoncolor, skycolor, smoothstep(-0.8, 0.9, zcomp(Q) / scale));
    color cloud = mix(undercolor, cloudcolor, lit);
    Oi = Os * mix(1, dense, clear);
    Ci = Oi * mix(sky, cloud, dense);
}
