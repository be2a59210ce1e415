/* nebula.sl: glowing gas: wisps of coloured light along the way, that hide nothing.
   Parameters: glow, scale, steps of the march, the three colours from thin to dense. */
volume nebula(float glow = 0.16; float scale = 0.7; float steps = 24;
              color thin = color(0.10, 0.05, 0.35); color middle = color(0.55, 0.08, 0.35);
              color dense = color(1, 0.70, 0.35);) {
    color light = 0;
    float way = min(length(I), 14);
    vector forward = normalize(I) * (way / steps);
    point p = P - I + forward * float random();
    uniform float k;
    for (k = 0; k < steps; k += 1) {
        point q = scale * transform("world", p);
        vector drift = 1.6 * (vector noise(0.6 * q) - vector(0.5, 0.5, 0.5));
        float rho = 1 - abs(2 * float noise(q + drift, 0.3 * time) - 1);
        rho = pow(rho, 4) * float noise(0.5 * q + vector(8, 8, 8));
        light += rho * color spline(rho * 1.6, thin, thin, middle, dense, dense);
        p += forward;
    }
    Ci += glow * light * way / steps;
}
